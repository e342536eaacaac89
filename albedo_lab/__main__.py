"""`python -m albedo_lab` is `albedo-lab`."""

from albedo_lab.cli import main

main(prog_name="albedo-lab")
