"""Arrays of numbers in source text of C, C++, GLSL and their like, whoever wrote them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

from albedo_lab.errors import BadInput
from albedo_lab.lookup.formats.numerals import NUMERAL, understood
from albedo_lab.lookup.formats.stored import Stored

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\r?\n)*[^\n]*", re.MULTILINE)
DEFINED = re.compile(r"#\s*define\s+(\w+)\s+\(?(\d+)\)?\s*$|\bint(?:eger)?\s+(\w+)\s*=\s*(\d+)\s*;", re.MULTILINE)
ASSIGNED = re.compile(r"=\s*(?:new\s)?|(?<=[\w>\]])\s*(?=\{)")
"""Where an initialiser may begin: after an equals sign, or the braces right after a name."""
TOKEN = re.compile(
    rf"\s*(?:(?P<number>(?<![\w.]){NUMERAL})(?P<suffix>[a-zA-Z_]*)|(?P<word>[A-Za-z_][\w:.]*)|(?P<sign>[{{}}()\[\],<>*;+-]))"
)
EXTENT = re.compile(r"\[([^\]]*)\]")
VECTOR = re.compile(r"\b(?:[df]?vec|float|double|half)([234])\b")
BITS = {"unsigned char": 8, "uint8_t": 8, "uchar": 8, "unsigned short": 16, "uint16_t": 16, "ushort": 16}
SINGLE = re.compile(r"\b(?:float[234]?|vec[234])\b")
OPENING, CLOSING = "{([", "})]"


@dataclass
class Numbers:
    """The numbers of an initialiser in order, the type words among them, and where it ends.

    `shape` is that of its nested brackets, None where they differ in length; `singles` whether a number has the suffix f.
    """

    texts: list[str]
    shape: tuple[int, ...] | None
    words: str
    singles: bool
    end: int


def decode(data: bytes, where: str) -> list[Stored]:
    """Every array of numbers that the text declares, or the one bare list that it is.

    The shape is that of the declaration, or of nested braces; a type of vectors adds their components as last axis. Raises
    BadInput for text that holds neither, and for an array that has another number of numbers than it declares.
    """
    source = data.decode("utf-8-sig", errors="replace")
    text = COMMENT.sub(" ", source)
    constants = {a or b: int(x or y) for a, x, b, y in DEFINED.findall(text)}
    text = DIRECTIVE.sub(" ", text)
    found, end = [], 0
    for start in ASSIGNED.finditer(text):
        if start.end() < end:
            continue
        numbers = _initialiser(text, start.end())
        if numbers is not None and len(numbers.texts) > 1:
            head = re.split(r"[;{}]|\)\s*$", text[end : start.start()])[-1]
            found.append(_declared(head, numbers, constants, where))
            end = numbers.end
    if found:
        return found
    bare = _initialiser("{" + text + "}", 0)
    if bare is None or not bare.texts:
        raise BadInput("file", where, "holds no array of numbers, as in float NAME[] = {0.5, 1.0};")
    return [_declared("", bare, {}, where)]


def _initialiser(text: str, start: int) -> Numbers | None:
    """The numbers in the brackets that open at `start`, perhaps behind the words of a constructor; None where there is more."""
    texts: list[str] = []
    words: list[str] = []
    open_, shapes = [], [[]]  # type: list[str], list[list[tuple[int, ...] | None]]
    singles, at = False, start
    while token := TOKEN.match(text, at):
        at = token.end()
        if token["number"]:
            if not open_:
                return None
            singles |= token["suffix"].lower() == "f"
            if token["suffix"].lower() not in ("", "f", "h", "hf", "l", "lf", "u", "us"):
                return None
            texts.append(token["number"])
            shapes[-1].append(())
        elif token["word"]:
            word = token["word"]
            # a constructor's own extent, as in float[32](, and template arguments are no values
            constructor = re.compile(r"(?:\s*<[^;{}()=]*>)?(?:\s*\[[^\]{}()=]*\])*\s*(?=[({\[])").match(text, at)
            if constructor is None or (shapes[-1] and not open_):
                return None
            words.append(word + text[at : constructor.end()])
            at = constructor.end()
        elif token["sign"] in OPENING:
            open_.append(token["sign"])
            shapes.append([])
        elif token["sign"] in CLOSING:
            if not open_ or OPENING.index(open_.pop()) != CLOSING.index(token["sign"]):
                return None
            shapes[-2].append(_joined(shapes.pop()))
            if not open_:
                return Numbers(texts, shapes[0][0], " ".join(words), singles, at)
        elif token["sign"] != ",":
            return None
    return None


def _joined(inner: Sequence[tuple[int, ...] | None]) -> tuple[int, ...] | None:
    """The shape of a bracket from the shapes of what is in it; a bracket around one bracket is none of its own."""
    if len(inner) == 1 and inner[0] != ():
        return inner[0]
    return (len(inner), *inner[0]) if inner and inner[0] is not None and len(set(inner)) == 1 else None


def _declared(head: str, numbers: Numbers, constants: dict[str, int], where: str) -> Stored:
    """The array by its declaration."""
    name = _name(head)
    types = f"{head} {numbers.words}"
    sizes = _extents(head, numbers.words, constants)
    vector = VECTOR.search(types)
    components = (int(vector[1]),) if vector else ()
    count = len(numbers.texts)
    bits = next((n for word, n in BITS.items() if re.search(rf"\b{word}\b", types)), None)
    values, rounding, kind = understood(numbers.texts, numbers.singles or bool(SINGLE.search(types)), bits)
    shape = (*sizes, *components) if sizes else numbers.shape or (count // math.prod(components), *components)
    if math.prod(shape) != count:
        raise BadInput("file", where, f"{name} is declared to have {' x '.join(map(str, shape))} numbers and has {count}")
    return Stored(name, values.reshape(shape), rounding, kind)


def _name(head: str) -> str:
    """What the declaration calls the array: the word before its brackets, or the last one; empty in a bare list."""
    found = re.findall(r"[A-Za-z_]\w*", re.sub(r"<.*>|\[[^\]]*\]|\.", " ", head))
    return found[-1] if found else ""


def _extents(head: str, words: str, constants: dict[str, int]) -> tuple[int, ...]:
    """The sizes that a declaration tells, products taken apart; none where one of them is left out or not understood."""
    template = re.findall(r"std::array\s*<|,\s*([\w* ]+?)\s*>", head)
    told = EXTENT.findall(head) or [size for size in reversed(template) if size] or EXTENT.findall(words)
    sizes = []
    for factor in (factor.strip().rstrip("uU") for size in told for factor in size.strip().strip("()").split("*")):
        if factor.isdecimal():
            sizes.append(int(factor))
        elif factor in constants:
            sizes.append(constants[factor])
        else:
            return ()
    return tuple(sizes)
