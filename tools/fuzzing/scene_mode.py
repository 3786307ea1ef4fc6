"""Mode `scenes`: runs and judges random scenes; shrinks those that fail."""
import copy
import re
import shutil

from fuzzing.assets import make_assets
from fuzzing.oracle import CUT_OFF, judge
from fuzzing.registry import read_registry
from fuzzing.robots import files_in
from fuzzing.scenes import make_scene
from fuzzing.tables import Fault
from fuzzing.toml import to_toml

NAMES = {0: "done", 2: "refused", 3: "stopped with figures", CUT_OFF: "cut off, going on"}
REPEATED = 5      # every fifth scene is run twice
MOST_TRIES = 80   # attempts to shrink one scene


def prepare(bench):
    registry = read_registry()
    return {"registry": registry, "assets": make_assets(bench.program, bench.folder), "used": set()}


def lay_out(bench, scene, folder):
    """Writes the scene and its files into a folder without a run."""
    for run in ("out", "again"):
        shutil.rmtree(folder / run, ignore_errors=True)
    text = to_toml(scene)
    (folder / "scene.toml").write_text(text, encoding="utf-8")
    for name, data in bench.things["assets"].items():
        first = re.sub(r"^(beat2?)\.\d", r"\1.0", name)   # a sequence names its first
        if f'"{name}"' in text or f'"{first}"' in text:
            (folder / name).write_bytes(data)
    for name, data in files_in(text):
        (folder / name).write_bytes(data)


def attempt(bench, index, folder):
    scene, case = make_scene(bench.things["registry"], bench.random(index))
    lay_out(bench, scene, folder)
    code = judge(bench.program, scene, folder, twice=index % REPEATED == 0)
    if code != 2:
        bench.things["used"] |= case.used
    return NAMES[code]


def paths(value, here=()):
    """Paths of removable parts of a scene, larger parts before the parts they contain."""
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in entries:
        if isinstance(value, dict) or isinstance(inner, dict):
            yield (*here, key)
    for key, inner in entries if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from paths(inner, (*here, key))


def without(scene, path):
    """The scene without the part at this path, and without tables and lists that become empty."""
    smaller = copy.deepcopy(scene)
    owner = smaller
    for key in path[:-1]:
        owner = owner[key]
    del owner[path[-1]]
    return {key: value for key, value in smaller.items() if value not in ([], {})}


def still_fails(bench, scene, folder, fault):
    lay_out(bench, scene, folder)
    try:
        judge(bench.program, scene, folder, twice=fault.what == "repeat")
    except Fault as found:
        return found.what == fault.what
    except KeyError:   # the removed part is needed by the oracle
        pass
    return False


def shrink(bench, index, folder, fault):
    """Removes everything that the failure does not need; keeps the smallest scene with the same failure."""
    scene, _ = make_scene(bench.things["registry"], bench.random(index))
    (folder / "as_found.toml").write_text(to_toml(scene), encoding="utf-8")
    tries, shrunk = 0, True
    while shrunk and tries < MOST_TRIES:
        shrunk = False
        for path in paths(scene):
            tries += 1
            smaller = without(scene, path)
            if still_fails(bench, smaller, folder, fault):
                scene, shrunk = smaller, True
                break
            if tries >= MOST_TRIES:
                break
    still_fails(bench, scene, folder, fault)


def remarks(bench):
    """Words and keys of the registry that no scene has used."""
    used = bench.things["used"]
    keys, words = {(t, n) for t, n, _ in used}, used
    unused = []
    for table, entries in bench.things["registry"].items():
        for key in entries:
            if table in ("", "domain", "domain.boundary", "time") or key.name in ("lower", "upper"):
                continue
            if (table, key.name) not in keys and not table.endswith(".rotate"):
                unused.append(key.label)
            unused += [f'{key.label} = "{w}"' for w in key.choices if (table, key.name) in keys
                       and (table, key.name, w) not in words]
    yield f"{len(unused)} keys and words not met{': ' + ', '.join(unused) if len(unused) < 40 else ''}"
