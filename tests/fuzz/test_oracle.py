#!/usr/bin/python3
"""The fuzzer's oracle raises the right fault for each kind of wrong result, and none for a correct one."""
import copy
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from fuzzing import damage, energy, oracle, registry, scene_mode, scenes, tables, toml  # noqa: E402
from fuzzing.program import Done, kill_session, refused_by_sanitizer, session_members  # noqa: E402

SCENE = {"dimension": 2, "domain": {"lower": [0, 0], "upper": [1, 1], "cell_size": 0.1}, "liquid": {"density": 1000.0}}
COLUMNS = ("step", "time", "liquid_volume", "kinetic_energy", "potential_energy", "elastic_energy", "wall_seconds")
SQUARE = numpy.array([[0, 1], [1, 2], [2, 3], [3, 0]])


def stats(kinetic, potential=0.0, moved=0.0):
    rows = {"time": [0, 1], "dt": [0, 0.01], "liquid_volume": [0.5, 0.5], "volume_corrected": [0, moved],
            "volume_spilled": [0, 0],
            "kinetic_energy": [10, kinetic], "potential_energy": [2500, 2500 + potential], "elastic_energy": [0, 0],
            "max_speed": [0.2, 0.3], "work_gravity": [0, -potential], "work_tension": [0, 0], "work_sides": [0, 0],
            "work_solids": [0, 0], "lost_viscous": [0, 0], "lost_numerical": [0, 10 - kinetic - potential]}
    return {name: numpy.array(values, dtype=float) for name, values in rows.items()}


def ended(code, errors=""):
    return Done(code, "", errors, 10, 0.1, 0.1, 1 << 20)


def square(x, size=1.0):
    return numpy.array([[x, 0], [x + size, 0], [x + size, size], [x, size]]), SQUARE


class Ends(unittest.TestCase):
    def test_codes(self):
        oracle.check_end(ended(0), (0, 2), "check")
        oracle.check_end(ended(3, "seiche: not settled after 50 solves"), (0, 3), "run")
        for done, what in ((ended(1, "seiche: x"), "code 1"), (ended(-11), "code -11"), (ended(None), "time"),
                           (ended(2), "message"), (ended(3, "seiche: no figures"), "message"),
                           (ended(1, "==7==ERROR: AddressSanitizer: heap-use-after-free"), "sanitizer")):
            with self.assertRaises(tables.Fault) as found:
                oracle.check_end(done, (0, 2, 3), "run")
            self.assertEqual(found.exception.what, what)


    def test_allocation_beyond_the_sanitizer(self):
        done = refused_by_sanitizer(ended(1, "==7==ERROR: AddressSanitizer: requested allocation size 0x43233746e6900"))
        oracle.check_end(done, (0, 2), "run")
        self.assertEqual(done.code, 2)


class CutOff(unittest.TestCase):
    def test_many_short_steps(self):
        """Only a run that advances to the end in short steps is slow; one that stands still hangs."""
        for steps, wall, ranks, expected in ((200, 0.3, 1, True), (20, 3.0, 1, True), (200, 30.0, 1, False),
                                             (200, 30.0, 3, True), (20, 0.3, 1, False), (20, 0.3, 3, False)):
            with tempfile.TemporaryDirectory() as folder:
                rows = [f"{n},{n * 0.01},0.01,{wall}" for n in range(steps)]
                (pathlib.Path(folder) / "stats.csv").write_text("\n".join(["step,time,dt,wall_seconds", *rows]) + "\n")
                self.assertEqual(oracle.goes_on(pathlib.Path(folder), 60.0, ranks), expected)
        self.assertFalse(oracle.goes_on(pathlib.Path("/nonexistent"), 60.0, 1))


class Kills(unittest.TestCase):
    def test_ranks_in_process_groups_of_their_own(self):
        """As `mpirun` starts them: the death of their parent's group leaves them alive."""
        job = "import os, time; os.fork() or os.setpgid(0, 0); time.sleep(100)"
        process = subprocess.Popen([sys.executable, "-c", job], start_new_session=True)
        while len(session_members(process.pid)) < 2:
            time.sleep(0.01)
        kill_session(process.pid)
        self.assertEqual(session_members(process.pid), [])
        process.wait()


class Results(unittest.TestCase):
    def test_energy(self):
        energy.check_energy(SCENE, stats(9))
        energy.check_energy(SCENE, stats(260, -251))          # falling matter
        still = {**SCENE, "gravity": [0, 0]}
        with self.assertRaisesRegex(tables.Fault, "energy"):
            energy.check_energy(still, stats(11))
        energy.check_energy(still, stats(11, moved=0.02))      # 0.9 J of liquid that the volume control put back
        with self.assertRaisesRegex(tables.Fault, "energy"):
            energy.check_energy(SCENE, stats(10000))

    def test_speeds_that_nothing_explains(self):
        """Little liquid that the volume control moved does not excuse an explosion."""
        wild = {**stats(1e6, moved=0.02), "max_speed": numpy.array([0.2, 1e5])}
        with self.assertRaisesRegex(tables.Fault, "energy"):
            energy.check_energy({**SCENE, "gravity": [0, 0]}, wild)

    def test_energy_from_nowhere(self):
        fed = {**SCENE, "domain": {**SCENE["domain"], "boundary": {"x_lower": {"type": "inflow"}}}}
        def later(columns):   # the same with five steps before
            return {name: numpy.concatenate([numpy.repeat(v[:1], 5), v]) for name, v in columns.items()}
        energy.check_created(fed, later(stats(9)))
        fed_by_sides = {"work_sides": numpy.array([0.0, 890.0]), "lost_numerical": numpy.zeros(2)}
        energy.check_created(fed, later({**stats(900), **fed_by_sides}))
        with self.assertRaisesRegex(tables.Fault, "created"):
            energy.check_created({**fed, "gravity": [0, 0]}, later(stats(900)))

    def test_what_feeds_energy(self):
        self.assertFalse(energy.is_fed(SCENE))
        for key, value in (("gravity", ["sin(t)", 0]), ("solid", [{"kind": "kinematic"}]),
                           ("liquid", {"source": [{}]}), ("domain", {"boundary": {"x_lower": {"type": "inflow"}}})):
            self.assertTrue(energy.is_fed({**SCENE, key: value}), key)

    def test_edges_between_outflow_sides(self):
        """Only sides of different pressure that meet drive a flow round their edge."""
        outflow = [{"type": "outflow", "pressure": p} for p in (0.0, 1.0)]
        for sides, driven in (({"x_lower": outflow[1], "y_lower": outflow[0]}, True),
                              ({"x_lower": outflow[1], "x_upper": outflow[0]}, False),
                              ({"x_lower": outflow[1], "y_lower": outflow[1]}, False),
                              ({"x_lower": outflow[1], "y_lower": "no_slip"}, False)):
            self.assertEqual(energy.is_driven_round_an_edge({"domain": {"boundary": sides}}), driven)

    def test_overlap(self):
        self.assertEqual(tables.overlap(square(0), square(1.001)), 0)
        self.assertAlmostEqual(tables.overlap(square(0), square(0.9)), 0.1)
        self.assertGreater(tables.overlap(square(0.3, 0.2), square(0)), 0.05)

    def test_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "stats.csv"
            for text, fault in (("a,b\n1,2\n", ""), ("a,b\n1,nan\n", "finite"), ("a,b\n1\n", "table"), ("", "table")):
                path.write_text(text)
                if fault:
                    self.assertRaisesRegex(tables.Fault, fault, tables.check_finite, path)
                else:
                    tables.check_finite(path)

    def test_volume(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "log.txt").write_text("")
            for volume, wrong in ((0.5, False), (0.45, False), (0.4, True)):
                (folder / "summary.json").write_text(json.dumps(
                    {"liquid_volume": volume, "expected_volume": 0.5, "initial_volume": 0.5}))
                if wrong:
                    self.assertRaisesRegex(tables.Fault, "volume", oracle.check_volume, SCENE, folder)
                else:
                    oracle.check_volume(SCENE, folder)
            (folder / "log.txt").write_text("warning: step 3: the liquid's volume is 0.4 where 0.5 is expected\n")
            oracle.check_volume(SCENE, folder)

    def test_frames_without_fields(self):
        """Only where solids are all that is asked for a frame may be without grids."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "frames").mkdir()
            (folder / "frames" / "frame.0000.vdb").write_bytes(b"")
            for asked, faults, wrong in ((["solids"], ["file: no grids"], False), (["solids"], ["file: no time"], True),
                                         (["surface"], ["file: no grids"], True), (None, ["file: no grids"], True)):
                scene = {**SCENE, "output": {"frames": asked}} if asked else SCENE
                with unittest.mock.patch.object(oracle, "frame_faults", return_value=faults):
                    if wrong:
                        self.assertRaisesRegex(tables.Fault, "frame", oracle.check_frames, scene, folder)
                    else:
                        oracle.check_frames(scene, folder)


class Inputs(unittest.TestCase):
    def test_every_key_has_values(self):
        keys = registry.read_registry()
        self.assertEqual(list(scenes.uncovered(keys)), [])
        new = registry.Key("liquid", "salinity", "a number", (), False, "", ())
        self.assertEqual(list(scenes.uncovered({"liquid": [*keys["liquid"], new]})), ["[liquid] salinity"])
        shape = next(k for k in keys["solid[]"] if k.name == "shape")
        other = registry.Key("solid[]", "shape", shape.kind, (*shape.choices, "torus"), True, "", ())
        self.assertEqual(list(scenes.uncovered({"solid[]": [other]})), ["[solid[]] shape: torus"])

    def test_scenes_follow_from_their_seed(self):
        keys = registry.read_registry()
        one, other = (toml.to_toml(scenes.make_scene(keys, random.Random(7))[0]) for _ in range(2))
        self.assertEqual(one, other)

    def test_parts_are_left_out(self):
        scene = {"time": {"end": 1.0}, "solid": [{"name": "a", "pinned": {"shape": "box"}}]}
        kept = copy.deepcopy(scene)
        smaller = [scene_mode.without(scene, path) for path in scene_mode.paths(scene)]
        self.assertEqual(scene, kept)
        self.assertIn({"time": {"end": 1.0}}, smaller)
        self.assertIn({"time": {"end": 1.0}, "solid": [{"name": "a"}]}, smaller)

    def test_damage_changes_bytes(self):
        for n in range(300):
            for data in (b"", b"1.5 2\nf 1 2 3\n", bytes(range(256))):
                self.assertNotEqual(damage.damage(random.Random(n), data, text=bool(n % 2))[1], data)


if __name__ == "__main__":
    unittest.main()
