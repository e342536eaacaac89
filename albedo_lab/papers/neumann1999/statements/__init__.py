"""What the paper states in sentences and equations, in the order of its sections; grazing laws, which it has in several, last."""

from __future__ import annotations

from albedo_lab.papers.neumann1999.statements import (
    efficiency,
    generalised,
    grazing,
    half_vector,
    introduction,
    materials,
    mirror,
    results,
    sampling,
    stretched,
    table_1,
    ward_schlick,
)

STATEMENTS = tuple(
    statement
    for section in (
        introduction,
        table_1,
        stretched,
        mirror,
        generalised,
        sampling,
        efficiency,
        materials,
        half_vector,
        ward_schlick,
        results,
        grazing,
    )
    for statement in section.STATEMENTS
)
