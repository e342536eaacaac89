"""One file, one BRDF. Each reads like its paper and ends in its record, `MODEL`."""
