"""Reading of a Seiche run for other programs: scene, frames, poses of solids, meshes. Needs Python 3.11 alone."""
import bisect
import csv
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

# Colours of `seiche render`, linear light; a test compares them with src/render/palette.cpp.
BODY_COLORS = ((0.85, 0.52, 0.04), (0.72, 0.20, 0.03), (0.55, 0.05, 0.06), (0.30, 0.15, 0.06),
               (0.12, 0.33, 0.08), (0.26, 0.11, 0.40), (0.78, 0.73, 0.62), (0.75, 0.25, 0.32))
KINEMATIC_COLOR, STATIC_COLOR = (0.28, 0.28, 0.28), (0.52, 0.52, 0.52)
SAME_TIME = 1e-9  # s, and relative: times of tables have 17 digits
UP_AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "-x": (-1, 0, 0), "-y": (0, -1, 0), "-z": (0, 0, -1)}


class RunFault(Exception):
    """Fault of the command line or of a run's files; its text is for the user."""


def file_stems(names):
    """Distinct file names of solids, as Seiche makes them: letters, digits, '-', '_' and '.' stay."""
    stems = []
    for name in names:
        stem = "".join(chr(b) if chr(b).isalnum() and b < 128 or b in b"-_." else "_" for b in name.encode()[:200])
        if stem.startswith("."):
            stem = "_" + stem[1:]
        while stem in stems:
            stem += "_"
        stems.append(stem)
    return stems


class Solid:
    """One solid of the scene: name, file stem, kind, whether it is a container, colour in linear light."""

    def __init__(self, table, stem, bodies):
        self.name, self.stem = table["name"], stem
        self.kind = table.get("kind", "static")
        self.is_container = bool(table.get("invert", False))
        self.moves = self.kind != "static"
        self.deforms = self.kind in ("elastic", "deforming")
        self.is_body = self.kind not in ("static", "kinematic", "deforming")
        self.color = BODY_COLORS[bodies % len(BODY_COLORS)] if self.is_body else (
            KINEMATIC_COLOR if self.moves else STATIC_COLOR)


class Run:
    """A run directory: its scene, the numbers of its frames, its solids."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        self.scene = self._read_scene()
        self.frames = sorted(int(m[1]) for f in self._frame_folder().glob("frame.*.vdb")
                             if (m := re.fullmatch(r"frame\.(\d+)\.vdb", f.name)))
        if not self.frames:
            raise RunFault(f"{self.folder}: there are no frames (frames/frame.0000.vdb and on); "
                           "give the directory of a run")
        self.frame_rate = float(self.scene.get("time", {}).get("frame_rate", 24.0))
        self.lower, self.upper = (tuple(map(float, self.scene["domain"][k])) for k in ("lower", "upper"))
        self.solids = self._solids()

    def _frame_folder(self):
        return self.folder / "frames"

    def _read_scene(self):
        path = self.folder / "scene.toml"
        try:
            with open(path, "rb") as file:
                return tomllib.load(file)
        except OSError as fault:
            raise RunFault(f"{path}: cannot be read; give the directory of a run") from fault
        except tomllib.TOMLDecodeError as fault:
            raise RunFault(f"{path}: {fault}") from fault

    def _solids(self):
        tables = self.scene.get("solid", [])
        solids, bodies = [], 0
        for table, stem in zip(tables, file_stems([t["name"] for t in tables])):
            solids.append(Solid(table, stem, bodies))
            bodies += solids[-1].is_body
        return solids

    @property
    def is_flat(self):
        """Whether the run is in 2D."""
        return self.scene.get("dimension", 3) == 2

    @property
    def up(self):
        """Unit vector against gravity along the nearest axis; y without gravity, or where formulas give it."""
        try:
            gravity = [float(g) for g in self.scene.get("gravity", (0.0, -9.81, 0.0))]
        except ValueError:
            return UP_AXES["y"]
        axis = max(range(len(gravity)), key=lambda a: (abs(gravity[a]), -a))
        if gravity[axis] == 0:
            return UP_AXES["y"]
        return tuple(math.copysign(1, -gravity[axis]) if a == axis else 0 for a in range(3))

    @property
    def viscosity(self):
        """Viscosity of the liquid, Pa s; 0 where a formula gives it."""
        liquid = self.scene.get("liquid", {})
        rheology = liquid.get("rheology", {})
        value = rheology.get("viscosity_zero", rheology.get("viscosity", liquid.get("viscosity", 0)))
        return float(value) if isinstance(value, (int, float)) else 0.0

    def vdb(self, number):
        """Path of a frame's OpenVDB file."""
        return self._frame_folder() / f"frame.{number:04d}.vdb"

    def cache(self, solid):
        """Paths of an elastic solid's mesh at rest and of its point cache."""
        return tuple(self._frame_folder() / (solid.stem + end) for end in (".obj", ".pc2"))

    def choose_frames(self, text):
        """Numbers of frames named by all, 0-24 or 0,10,20."""
        if text == "all":
            return list(self.frames)
        chosen = set()
        for part in text.split(","):
            match = re.fullmatch(r"(\d+)(?:-(\d+))?", part.strip())
            if not match:
                raise RunFault(f"--frames: '{text}' is not a list of frames; give all, 0-24, or 0,10,20")
            first, last = int(match[1]), int(match[2] or match[1])
            for end in (first, last):
                if end not in self.frames:
                    raise RunFault(f"--frames: there is no frame {end}; the run has {self.frames[0]} to "
                                   f"{self.frames[-1]}")
            chosen.update(n for n in self.frames if first <= n <= last)
        return sorted(chosen)

    def times(self):
        """Time of each frame, s, by its number; those of solids.pvd where there are solids."""
        times = {n: n / self.frame_rate for n in self.frames}
        listing = self._frame_folder() / "solids.pvd"
        if listing.exists():
            pattern = r'timestep="([^"]+)"[^>]*file="solids\.(\d+)\.vtu"'
            times.update((int(n), float(t)) for t, n in re.findall(pattern, listing.read_text()))
        return times


class Pose:
    """Place of a solid: centre of mass, and quaternion (w, x, y, z) of the rotation from rest."""

    def __init__(self, position, quaternion):
        self.position, self.quaternion = tuple(position), tuple(quaternion)

    def to_body(self, point):
        """Point of the domain in the solid's own frame, whose origin is the centre of mass."""
        offset = [p - c for p, c in zip(point, self.position)]
        w, x, y, z = self.quaternion
        return rotate((w, -x, -y, -z), offset)

    def to_domain(self, point):
        """Point of the solid's own frame in the domain."""
        return tuple(c + r for c, r in zip(self.position, rotate(self.quaternion, point)))


def rotate(quaternion, v):
    """Vector v turned by a unit quaternion (w, x, y, z)."""
    w, x, y, z = quaternion
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0])


class Poses:
    """Poses of solids.csv."""

    def __init__(self, run):
        self.path = run.folder / "solids.csv"
        self.rows = {}
        try:
            with open(self.path, newline="", encoding="utf-8") as file:
                for line, row in enumerate(csv.DictReader(file), 2):
                    self._add(line, row)
        except OSError as fault:
            raise RunFault(f"{self.path}: cannot be read; it places the solids of a run") from fault

    def _add(self, line, row):
        try:
            numbers = [float(row[key]) for key in ("time", "x", "y", "z", "qw", "qx", "qy", "qz")]
            self.rows.setdefault(row["name"], []).append((numbers[0], Pose(numbers[1:4], numbers[4:])))
        except (KeyError, TypeError, ValueError) as fault:
            raise RunFault(f"{self.path}:{line}: is no row of a solid") from fault

    def at(self, name, time):
        """Pose of a solid at the time of a frame, s."""
        same = SAME_TIME * max(1.0, abs(time))
        rows = self.rows.get(name, [])
        place = bisect.bisect_left(rows, time - same, key=lambda row: row[0])
        if place < len(rows) and rows[place][0] <= time + same:
            return rows[place][1]
        raise RunFault(f"{self.path}: there is no row of '{name}' at t = {time:g} s, the time of a frame")

    def along(self, name, times):
        """Poses at several times; signs of quaternions are such that neighbours are close."""
        poses = [self.at(name, t) for t in times]
        for before, pose in zip(poses, poses[1:]):
            if sum(a * b for a, b in zip(before.quaternion, pose.quaternion)) < 0:
                pose.quaternion = tuple(-q for q in pose.quaternion)
        return poses


def product(p, q):
    """Product of quaternions: the rotation q, then p."""
    return (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])


def angles_xyz(quaternion, near=(0.0, 0.0, 0.0)):
    """Angles (degrees) of turns about the fixed axes x, then y, then z; whole turns are chosen near earlier angles."""
    w, x, y, z = quaternion
    sine = max(-1.0, min(1.0, 2 * (w * y - x * z)))
    angles = (math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), math.asin(sine),
              math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    other = (angles[0] + math.pi, math.pi - angles[1], angles[2] + math.pi)  # the same rotation
    choices = []
    for triple in (angles, other):
        degrees = [math.degrees(a) for a in triple]
        choices.append(tuple(d + 360 * round((n - d) / 360) for d, n in zip(degrees, near)))
    return min(choices, key=lambda c: sum(abs(a - b) for a, b in zip(c, near)))


def quaternion_to_z(up):
    """Quaternion (w, x, y, z) of the least rotation that takes an axis to z."""
    if up[2] < -0.5:
        return (0.0, 1.0, 0.0, 0.0)
    half = math.sqrt(0.5)
    return (1.0, 0.0, 0.0, 0.0) if up[2] > 0.5 else (half, half * up[1], -half * up[0], 0.0)


def find_program(given=None):
    """Path of the program seiche: as given, in $SEICHE, beside this folder, on the path."""
    here = pathlib.Path(__file__).resolve()
    places = [given, os.environ.get("SEICHE"), here.parents[2] / "build/release/seiche",
              here.parents[3] / "bin/seiche", shutil.which("seiche")]
    if given and not pathlib.Path(given).is_file():
        raise RunFault(f"--seiche: there is no file {given}")
    for place in places:
        if place and pathlib.Path(place).is_file():
            return str(place)
    raise RunFault("the program seiche was not found; name it with --seiche PATH, in $SEICHE, or put it on the path")


def mesh_file(folder, stem, number=None, form="ply"):
    """Path of a mesh that `seiche export` writes; without a number for what does not move."""
    return pathlib.Path(folder) / (f"{stem}.{form}" if number is None else f"{stem}.{number:04d}.{form}")


def is_exported(run, folder, frames, form="ply"):
    """Whether a folder has the meshes of all these frames, none older than the frame."""
    for number in frames:
        files = [mesh_file(folder, "liquid", number, form)]
        files += [mesh_file(folder, s.stem, number if s.moves else None, form) for s in run.solids]
        if not all(f.exists() for f in files) or files[0].stat().st_mtime < run.vdb(number).stat().st_mtime:
            return False
    return True


def export_meshes(run, frames, given=None, form="ply", say=print):
    """Folder with the meshes of these frames in the scene's axes; calls `seiche export` if some are missing or old."""
    turned = run.scene.get("output", {}).get("up", "scene") != "scene"   # what lies in export/ may be turned
    folder = run.folder / ("export_scene_axes" if turned else "export")
    if run.is_flat:
        raise RunFault(f"{run.folder}: is a run in 2D; meshes of the liquid exist for 3D runs")
    if is_exported(run, folder, frames, form):
        return folder
    command = [find_program(given), "export", str(run.folder), "--format", form, "--frames",
               "all" if frames == run.frames else ",".join(map(str, frames))]
    if turned:
        command += ["--up", "scene", "--out", str(folder)]
    say("running: " + " ".join(command))
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RunFault(f"seiche export ended with code {done.returncode}: {done.stderr.strip()}")
    return folder


def end_with(fault):
    """Ends the program with a line on the fault and exit code 2."""
    print(f"seiche: {fault}", file=sys.stderr, flush=True)
    sys.exit(2)
