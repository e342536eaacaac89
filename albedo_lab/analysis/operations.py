"""Operations that a formula executes, counted in the byte code while it runs, so that a series counts each of its terms."""

from __future__ import annotations

import dis
import sys
from collections import Counter
from collections.abc import Callable
from types import CodeType, FrameType
from typing import Any

ELEMENTARY = "albedo_lab.optics.maths"
KINDS = {
    "+": "add",
    "-": "add",
    "*": "multiply",
    "/": "divide",
    "sqrt": "root",
    "min": "compare",
    "max": "compare",
    "abs": "compare",
}
"""What counts as what; comparisons are COMPARE, and whatever else is called is a FUNCTION: exp, pow, erfc, arctangent."""
COMPARE, FUNCTION = "compare", "function"
OPERATIONS = ("add", "multiply", "divide", "root", FUNCTION, COMPARE)


def operations(formula: Callable[..., Any], *arguments: Any) -> Counter[str]:
    """How many operations of each kind of OPERATIONS a formula executes, in its callees too.

    Constants such as 4 pi count as they are written, though a compiler folds them. Plain functions of `math` and of
    `optics.maths` count as one each. The formula must be Python, not compiled.
    """
    counted: Counter[str] = Counter()
    codes: dict[CodeType, dict[int, dis.Instruction]] = {}

    def step(frame: FrameType, event: str, argument: Any) -> Any:
        if event == "opcode":
            code = frame.f_code
            if code not in codes:
                codes[code] = {instruction.offset: instruction for instruction in dis.get_instructions(code)}
            instruction = codes[code][frame.f_lasti]
            if instruction.opname == "BINARY_OP":
                counted[KINDS.get(instruction.argrepr.rstrip("="), FUNCTION)] += 1
            elif instruction.opname in ("COMPARE_OP", "UNARY_NEGATIVE"):
                counted[COMPARE if instruction.opname == "COMPARE_OP" else "add"] += 1
        return step

    def enter(frame: FrameType, event: str, argument: Any) -> Any:
        if frame.f_globals.get("__name__") == ELEMENTARY:
            counted[FUNCTION] += 1
            return None
        frame.f_trace_opcodes, frame.f_trace_lines = True, False
        return step

    def call(frame: FrameType, event: str, argument: Any) -> None:
        name = getattr(argument, "__name__", "")
        if event == "c_call" and frame.f_globals.get("__name__") != ELEMENTARY and name not in UNCOUNTED:
            counted[KINDS.get(name, FUNCTION)] += 1

    before = sys.gettrace(), sys.getprofile()
    sys.setprofile(call)
    sys.settrace(enter)
    try:
        formula(*arguments)
    finally:
        sys.settrace(before[0])
        sys.setprofile(before[1])
    return counted


UNCOUNTED = {"__new__", "settrace", "setprofile", "range", "int", "float"}
"""Making a named tuple, and what ends the count."""
