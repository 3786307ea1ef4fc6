"""Runs the code cells of a notebook one after another, in a folder that is removed.

Usage: run_notebook.py FILE.ipynb    Exit code 0 if no cell raised an exception."""
import json
import os
import pathlib
import sys
import tempfile


def main(path):
    notebook = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    names = {"__name__": "__main__"}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for number, cell in enumerate(cells, 1):
            exec(compile(cell, f"{pathlib.Path(path).name}, cell {number}", "exec"), names)
        os.chdir("/")


if __name__ == "__main__":
    main(sys.argv[1])
