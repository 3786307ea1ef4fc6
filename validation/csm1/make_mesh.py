#!/usr/bin/python3
"""The flag of Turek and Hron, from the cylinder to x = 0.6, as a Medit mesh: make_mesh.py N > mesh_N.mesh, N elements
through the thickness."""
import math
import sys

n = int(sys.argv[1])
m = 70 * n // 4
print("MeshVersionFormatted 2\nDimension 2\nVertices", (m + 1) * (n + 1), sep="\n")
for j in range(n + 1):
    y = -0.01 + 0.02 * j / n
    start = math.sqrt(0.05**2 - y**2)
    for i in range(m + 1):
        print(f"{0.2 + start + (0.4 - start) * i / m:.17g} {0.2 + y:.17g} 0")
print("Triangles", 2 * m * n, sep="\n")
for j in range(n):
    for i in range(m):
        a = j * (m + 1) + i + 1
        print(f"{a} {a + 1} {a + m + 2} 1\n{a} {a + m + 2} {a + m + 1} 1")
print("End")
