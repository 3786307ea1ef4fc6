"""Parts of tools/fuzz: random scenes, damaged files and kills for the built program."""
