#!/usr/bin/env python3
"""tools/check_layers finds the offence in small trees that break one rule each."""
import importlib.machinery
import importlib.util
import pathlib
import sys
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[2]


def load_check_layers():
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader("check_layers", str(TOP / "tools" / "check_layers"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_layers", loader))
    loader.exec_module(module)
    return module


LAYERS = load_check_layers()


def offences(files):
    """Offences of a tree of these files, without those of missing README pages."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return [o for o in LAYERS.check(pathlib.Path(folder))[1] if "README.md" not in o]


def including(header):
    return f'#include "{header}"\n'


class Arrows(unittest.TestCase):
    def test_downwards_is_allowed(self):
        tree = {"src/fluid/pressure/a.cpp": including("linalg/spd/b.h"), "src/linalg/spd/b.h": ""}
        self.assertEqual(offences(tree), [])

    def test_a_room_above_is_refused(self):
        self.assertIn("src/fluid/pressure may not include src/coupling/state (coupling/state/b.h)",
                      offences({"src/fluid/pressure/a.h": including("coupling/state/b.h")})[0])

    def test_a_folder_above_in_the_same_room_is_refused(self):
        self.assertEqual(len(offences({"src/linalg/precond/a.cpp": including("linalg/spd/b.h")})), 1)

    def test_a_room_beside_is_refused(self):
        self.assertEqual(len(offences({"src/solid/body/a.cpp": including("fluid/boundary/b.h")})), 1)

    def test_only_the_named_folder_of_a_room_is_open(self):
        self.assertEqual(offences({"src/scene/a.cpp": including("fluid/rheology/b.h")}), [])
        self.assertEqual(len(offences({"src/scene/a.cpp": including("fluid/pressure/b.h")})), 1)

    def test_files_in_no_room_are_refused(self):
        self.assertEqual(len(offences({"src/fluid/a.cpp": "", "src/gas/b.cpp": ""})), 2)

    def test_the_table_itself_has_no_circle(self):
        self.assertEqual(list(LAYERS.faults_of_table()), [])


class Libraries(unittest.TestCase):
    def test_an_include_belongs_to_the_adapter(self):
        self.assertEqual(offences({"src/linalg/precond/hypre_adapter.cpp": "#include <HYPRE.h>\n"}), [])
        self.assertEqual(len(offences({"src/linalg/spd/a.cpp": "#include <HYPRE.h>\n"})), 2)  # written, and reached

    def test_cholmod_is_seen_through_eigen(self):
        self.assertTrue(offences({"src/solid/elastic/a.cpp": "#include <Eigen/CholmodSupport>\n"}))

    def test_names_that_a_header_brought_along_are_refused(self):
        tree = {"src/base/communicator.h": "#include <mpi.h>\n",
                "src/linalg/core/a.cpp": including("base/communicator.h") + "int n = MPI_Barrier(c);  // MPI_Send\n"}
        self.assertEqual([o.split(": ", 1)[0] for o in offences(tree)], ["src/linalg/core/a.cpp:2"])

    def test_comments_and_texts_may_name_them(self):
        self.assertEqual(offences({"src/linalg/core/a.cpp": '// MPI_Barrier\nauto text = "MPI_Send";\n'}), [])

    def test_a_room_that_is_to_know_nothing_of_mpi_must_not_reach_it(self):
        tree = {"src/base/communicator.h": "#include <mpi.h>\n", "src/base/b.h": including("base/communicator.h"),
                "src/solid/contact/a.cpp": including("base/b.h")}
        self.assertEqual(offences(tree), ["src/solid/contact/a.cpp:1: src/solid/contact is to know nothing of MPI, "
                                          "which base/b.h brings in"])


class Pages(unittest.TestCase):
    def test_the_pages_of_the_rooms_say_what_the_table_does(self):
        self.assertEqual(list(LAYERS.readme_offences(TOP)), [])
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(list(LAYERS.readme_offences(pathlib.Path(folder)))), len(LAYERS.ROOMS))


if __name__ == "__main__":
    unittest.main()
