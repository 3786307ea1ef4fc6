"""The scenes that benchmarks/run_cases times."""
import pathlib
import re
from dataclasses import dataclass, field

TOP = pathlib.Path(__file__).resolve().parent.parent


@dataclass
class Case:
    name: str
    what: str
    path: str  # of the scene, from the top of the project
    settings: dict = field(default_factory=dict)  # as of --set
    skipped_steps: int = 0  # the first ones, which the median leaves out
    edits: tuple = ()  # (pattern, text in its place) in the scene's file

    def scene_in(self, folder):
        """Path of the scene; one that is edited is written into the folder."""
        if not self.edits:
            return TOP / self.path
        text = (TOP / self.path).read_text(encoding="utf-8")
        for pattern, replacement in self.edits:
            text = re.sub(pattern, replacement, text)
        scene = folder / "scene.toml"
        scene.write_text(text, encoding="utf-8")
        return scene


CASES = {case.name: case for case in (
    Case("dam_break_128", "dam break of 128^3 cells, no bodies", "benchmarks/cases/dam_break_128.toml",
         {"time.end": 0.15}, skipped_steps=1),
    Case("dam_break_128_high", "the same under twice the height", "benchmarks/cases/dam_break_128.toml",
         {"domain.upper": "[1.0,2.0,1.0]", "time.end": 0.15}, skipped_steps=1),
    Case("full_box_96", "a box of 96^3 cells full of liquid, no empty cell",
         "benchmarks/cases/full_box_96.toml", skipped_steps=1),
    Case("demo", "ducks, boxes and a soft ball: the default scene of ./demo, its first 0.3 s",
         "scenes/ducks_and_ball.toml", {"time.end": 0.3}),
    Case("soft_balls", "two soft balls and a crate that meet above water, 0.227 s",
         "benchmarks/cases/two_soft_balls_and_crate.toml", {"time.end": 0.2274}, skipped_steps=7),
    Case("boxes_200", "200 rigid boxes that fall into a tank of 64^3 cells and collide, to 0.25 s",
         "benchmarks/cases/boxes_200.toml", {"time.end": 0.25}, skipped_steps=8),
    Case("boxes_200_static", "the same boxes held where they start", "benchmarks/cases/boxes_200.toml",
         {"time.end": 0.25, "time.max_step": 0.01}, skipped_steps=8,
         edits=(('kind = "rigid"', 'kind = "static"'), (r"density = \d+, friction", "friction"))),
    Case("chain_2d", "a dry chain of 100 links on hinges, in 2D", "benchmarks/cases/chain_2d.toml", skipped_steps=2),
    Case("chain_3d", "the same in 3D", "benchmarks/cases/chain_3d.toml", skipped_steps=2),
    Case("immersed_block", "an elastic block under water, one step", "benchmarks/cases/immersed_block.toml"),
    Case("immersed_block_fine", "the same of some 1e5 tetrahedra, eight steps", "benchmarks/cases/immersed_block.toml",
         {"solid.0.element_size": 0.0135, "time.end": 0.008}, skipped_steps=2),
)}
