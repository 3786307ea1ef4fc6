#!/usr/bin/python3
"""Cook's membrane in blocks of two triangles, n along each side, as a Medit mesh: make_mesh.py N > mesh_N.mesh"""
import sys

n = int(sys.argv[1])
print("MeshVersionFormatted 2\nDimension 2\nVertices", (n + 1) ** 2, sep="\n")
for j in range(n + 1):
    for i in range(n + 1):
        s, t = i / n, j / n
        print(f"{48 * s:.17g} {44 * s + t * (44 - 28 * s):.17g} 0")
print("Triangles", 2 * n * n, sep="\n")
for j in range(n):
    for i in range(n):
        a = j * (n + 1) + i + 1
        print(f"{a} {a + 1} {a + n + 2} 1\n{a} {a + n + 2} {a + n + 1} 1")
print("End")
