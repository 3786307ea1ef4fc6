"""Packs the module as a wheel, unpacks it as pip does, and imports it from there: test_wheel.py BUILD_FOLDER."""
import base64
import csv
import hashlib
import pathlib
import subprocess
import sys
import tempfile
import zipfile

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools/wheel"
SCENE = "dimension = 2\\n[domain]\\nupper = [1, 1]\\ncell_size = 0.125\\n[time]\\nend = 1\\n"
USE = f'import seiche; s = seiche.Simulation(seiche.Scene.parse("{SCENE}")); s.step(); print(seiche.__file__, s.time > 0)'


def check_record(archive, folder):
    """Every file but RECORD stands in it with its hash and size."""
    record = next(name for name in archive.namelist() if name.endswith("RECORD"))
    rows = {row[0]: row for row in csv.reader(archive.read(record).decode().splitlines())}
    assert set(rows) == set(archive.namelist()), rows
    for name in set(rows) - {record}:
        data = (folder / name).read_bytes()
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        assert rows[name][1:] == [f"sha256={digest}", str(len(data))], name


def main(build):
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch)
        made = subprocess.run([TOOL, build, out], check=True, capture_output=True, text=True).stdout.strip()
        with zipfile.ZipFile(made) as archive:
            archive.extractall(out / "site")
            check_record(archive, out / "site")
        used = subprocess.run([sys.executable, "-c", USE], env={"PYTHONPATH": str(out / "site")}, cwd=scratch,
                              capture_output=True, text=True)
        assert used.returncode == 0, used.stderr
        where, moved = used.stdout.split()[-2:]
        assert where.startswith(scratch) and moved == "True", used.stdout
        empty = subprocess.run([TOOL, out, out], capture_output=True, text=True)
        assert empty.returncode == 1 and "-DSEICHE_PYTHON=ON" in empty.stderr, empty.stderr


main(sys.argv[1])
