#!/usr/bin/env python3
"""Makes the pages of the C++ interface into a folder: build_api.py BUILD FOLDER

Doxygen has nothing to warn of, and the pages tell what headers say. Ends with 77, for "skipped", without doxygen."""
import os
import pathlib
import shutil
import subprocess
import sys

# A class and a sentence of its header that its page must have.
TOLD = {"classseiche_1_1Simulation.html": "Advances by one step that ends at or before",
        "structseiche_1_1StepStats.html": "One row of stats.csv",
        "structseiche_1_1SolidAtStart.html": "of the volume outside of the domain"}


def main():
    build, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    if not shutil.which("doxygen"):
        print("doxygen is not installed")
        return 77
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    subprocess.run(["doxygen", str(build / "Doxyfile")], env={**os.environ, "API_OUTPUT": str(folder)}, check=True)
    faults = (folder / "warnings.txt").read_text(encoding="utf-8").splitlines()
    for name, sentence in TOLD.items():
        page = folder / "html" / name
        if not page.is_file() or sentence not in page.read_text(encoding="utf-8"):
            faults.append(f"{name} does not say '{sentence}'")
    pages = len(list((folder / "html").glob("*.html")))
    print("\n".join(faults + [f"api: {pages} pages, {len(faults)} faults"]))
    return 1 if faults or pages < 200 else 0


if __name__ == "__main__":
    sys.exit(main())
