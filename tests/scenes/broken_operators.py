#!/usr/bin/env python3
"""Validation notices wrong operators: broken_operators.py SEICHE CASES OUT.

For each main operator a quick case runs with the operator multiplied by a factor and must not pass. That each case
passes unperturbed is shown by the tests "validate: ...". Factors are close to one if the case is sensitive enough.
"""
import pathlib
import shutil
import subprocess
import sys

# operator, factor, case that must detect it
BROKEN = [
    ("pressure_gradient", "0.95", "taylor_green_carried"),
    ("pressure_gradient", "0.95", "rest"),
    ("divergence", "0.95", "rest"),
    ("gravity", "0.95", "sloshing"),
    ("gas_density", "0.5", "rising_bubble_speed"),
    ("surface_tension", "0.95", "laplace_pressure"),
    ("solid_flux", "0.95", "added_mass_cylinder"),
    ("solid_flux", "-1", "floating_log"),
    ("viscosity", "0.9", "taylor_green_viscous"),
    ("viscosity", "0.9", "couette_torque"),
    ("yield_stress", "0.9", "bingham_channel"),
    ("velocity_advection", "0.95", "taylor_green_carried"),
    ("surface_advection", "0.9", "dam_break_martin_moyce"),
    ("surface_advection", "0.99", "zalesak_disk"),
    ("rigid_mass", "0.95", "added_mass_cylinder"),
    ("contact", "-1", "friction_incline"),
    ("friction", "0.9", "friction_incline"),
    ("friction", "0.9", "friction_stop"),
    ("elastic_forces", "0.9", "cantilever"),
    ("elastic_forces", "0.95", "cook_membrane"),
]


def validate(seiche, cases, out, case, extra):
    command = [seiche, "validate", case, "--cases", cases, "--out", str(out), "--threads", "1", *extra]
    return subprocess.run(command, capture_output=True, text=True, timeout=600)


def operators(seiche, cases, out):
    """Names that --break accepts, from its message about a wrong one."""
    run = validate(seiche, cases, out / "names", "rest", ["--break", "none:1"])
    return run.stderr.strip().split("operator one of ")[-1].split(", ")


def main():
    seiche, cases, out = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    shutil.rmtree(out, ignore_errors=True)
    failures = 0
    for name in operators(seiche, cases, out):
        if name not in {operator for operator, _, _ in BROKEN}:
            failures += 1
            print(f"no case is asked to notice a wrong {name}")
    for operator, factor, case in BROKEN:
        run = validate(seiche, cases, out / "broken", case, ["--break", f"{operator}:{factor}"])
        noticed = run.returncode in (1, 3)  # a missed bar; a run that could not continue
        failures += not noticed
        print(f"{operator} x {factor}: {case} {'notices' if noticed else 'DOES NOT NOTICE'} ({run.returncode})")
        if not noticed:
            print(run.stdout + run.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
