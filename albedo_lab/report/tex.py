"""Text for LaTeX in plain ASCII, whatever characters the documents and the findings use."""

from __future__ import annotations

import re
import unicodedata

from albedo_lab.report.formats import LATEX

ACCENTS = {"\u0300": "`", "\u0301": "'", "\u0302": "^", "\u0303": "~", "\u0304": "=", "\u0308": '"', "\u030c": "v", "\u0327": "c"}
ACCENTED = re.compile(f"([A-Za-z])([{''.join(ACCENTS)}])")
"""A letter and an accent in two characters: F̄."""
GREEK_AS_LATIN = dict(zip("ΑΒΕΖΗΙΚΜΝΟΡΤΧο", "ABEZHIKMNOPTXo", strict=True))
MATHS = {
    "±": r"\pm",
    "·": r"\cdot",
    "×": r"\times",
    "∞": r"\infty",
    "→": r"\to",
    "⇒": r"\Rightarrow",
    "⇔": r"\Leftrightarrow",
    "↔": r"\leftrightarrow",
    "−": "-",
    "°": r"^\circ",
    "∘": r"\circ",
    "∫": r"\int",
    "∬": r"\int\!\!\int",
    "∑": r"\sum",
    "∏": r"\prod",
    "∂": r"\partial",
    "∇": r"\nabla",
    "√": r"\surd",
    "≤": r"\le",
    "≥": r"\ge",
    "≪": r"\ll",
    "≫": r"\gg",
    "≠": r"\ne",
    "≈": r"\approx",
    "∼": r"\sim",
    "≃": r"\simeq",
    "≡": r"\equiv",
    "∝": r"\propto",
    "∈": r"\in",
    "∉": r"\notin",
    "⊥": r"\perp",
    "∥": r"\parallel",
    "‖": r"\|",
    "∣": r"\mid",
    "≲": r"\lesssim",
    "≳": r"\gtrsim",
    "≅": r"\cong",
    "≔": r":=",
    "⊂": r"\subset",
    "⁄": "/",
    "ð": r"\eth",
    "Γ": r"\Gamma",
    "∧": r"\wedge",
    "∨": r"\vee",
    "∩": r"\cap",
    "∪": r"\cup",
    "⟨": r"\langle",
    "⟩": r"\rangle",
    "⌊": r"\lfloor",
    "⌋": r"\rfloor",
    "†": r"\dagger",
    "∗": "*",
    "⋅": r"\cdot",
    "…": r"\ldots",
    "⋯": r"\cdots",
    "′": r"^\prime",
    "″": r"^{\prime\prime}",
    "ℓ": r"\ell",
    "ϕ": r"\phi",
    "ϑ": r"\vartheta",
    "ϵ": r"\epsilon",
    "φ": r"\varphi",
    "ε": r"\varepsilon",
    "ς": r"\varsigma",
    "⟂": r"\perp",
    "∀": r"\forall",
    "∃": r"\exists",
    "¬": r"\neg",
    "¼": r"\frac14",
    "½": r"\frac12",
    "¾": r"\frac34",
}
TEXT = {
    "§": r"\S",
    "–": "--",
    "—": "---",
    "‘": "`",
    "’": "'",
    "“": "``",
    "”": "''",
    "„": ",,",
    "«": "$\\ll$",
    "»": "$\\gg$",
    "\u00a0": "~",
    "\u2009": r"\,",
    "\u202f": r"\,",
    "\u2011": "-",
    "ß": r"\ss{}",
    "ø": r"\o{}",
    "æ": r"\ae{}",
    "•": r"$\bullet$",
    "©": r"\copyright{}",
    "µ": r"$\mu$",
}


class _Table(dict[int, str]):
    """What `str.translate` asks; a character is looked up once."""

    def __missing__(self, code: int) -> str:
        if code < 128:
            raise LookupError(code)  # which leaves it as it is
        self[code] = _spelled(chr(code))
        return self[code]


TEX = _Table()
"""Characters beyond ASCII; to be used after the special characters of `formats.LATEX`, or together with them."""


def tex(text: str) -> str:
    r"""The text with every special character escaped and every character beyond ASCII as a command.

    >>> print(tex("μ² = 5 %"))
    $\mu$$^2$ = 5 \%
    """
    return ACCENTED.sub(lambda found: f"\\{ACCENTS[found[2]]}{{{found[1]}}}", text.translate(LATEX)).translate(TEX)


def _spelled(character: str) -> str:
    """A command for a character beyond ASCII; one that no rule knows is shown by its number, not lost."""
    if character in TEXT:
        return TEXT[character]
    if character in MATHS:
        return f"${MATHS[character]}$"
    if character in GREEK_AS_LATIN:
        return GREEK_AS_LATIN[character]
    name = unicodedata.name(character, "")
    if name.startswith(("GREEK SMALL LETTER ", "GREEK CAPITAL LETTER ")) and name.count(" ") == 3:
        letter = name.rpartition(" ")[2].replace("LAMDA", "LAMBDA").lower()
        return f"$\\{letter.capitalize() if 'CAPITAL' in name else letter}$"
    kind, _, plain = unicodedata.decomposition(character).rpartition("> ")
    base = "".join(chr(int(code, 16)) for code in plain.split())
    if kind in ("<super", "<sub"):
        sign = "^" if kind == "<super" else "_"
        script = base.translate(TEX).replace("$", "")
        return f"${sign}{script}$" if len(script) == 1 else f"${sign}{{{script}}}$"
    if len(base) == 2 and base[1] in ACCENTS:
        return f"\\{ACCENTS[base[1]]}{{{base[0]}}}"
    return f"[U+{ord(character):04X}]"
