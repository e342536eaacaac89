"""The little Markdown that notes and captions use, as HTML: paragraphs, lists, code, strong and emphasised words, links."""

from __future__ import annotations

import re
import textwrap
from html import escape

from markupsafe import Markup

INLINE = (
    (re.compile(r"\*\*(.+?)\*\*"), r"<strong>\1</strong>"),
    (re.compile(r"(?<![\w*])\*(?!\s)([^*]+?)(?<!\s)\*(?![\w*])"), r"<em>\1</em>"),
    (re.compile(r"\[([^\]]+)\]\(([^)\s]+)\)"), r'<a href="\2">\1</a>'),
)
SUPERSCRIPT = re.compile(r"\^([-−+]?(?:\d+(?:\.\d+)?|[^\W\d_]\w*)|[+*′])")
SUBSCRIPT = re.compile(r"((?<!\w)[^\W\d_]|[)\]])_([^\W_]{1,3})(?!\w|\.\w)")
"""Letters below another, or below a bracket: k_d, f_att, (R·V)_M; but no names such as plus_phong."""
CODE = re.compile(r"(`[^`]+`)")
TAG = re.compile(r"(<[^>]*>)")
ITEM = re.compile(r"^- ", re.MULTILINE)


def prose(text: str) -> Markup:
    """Paragraphs, parted by empty lines; a paragraph whose lines start with "- " is a list.

    >>> prose("Most of it *holds*.")
    Markup('<p>Most of it <em>holds</em>.</p>')
    """
    return Markup("\n".join(_block(block) for block in re.split(r"\n\s*\n", textwrap.dedent(text).strip()) if block))


def words(text: str) -> Markup:
    """A line of it, without a paragraph around; nothing inside `code` is read as anything but code."""
    return Markup("".join(_inline(part) for part in CODE.split(escape(text, quote=False))))


def formula(text: str) -> Markup:
    """A quotation with its raised and lowered letters: x^(1−k), k_d. Nothing else in it is read as markup.

    >>> formula("k_d (N·L)^n < e^(-(a+b)/m)")
    Markup('k<sub>d</sub> (N·L)<sup>n</sup> &lt; e<sup>-(a+b)/m</sup>')
    """
    return Markup(_raised(escape(text, quote=False)))


def _raised(text: str) -> str:
    """Superscripts and subscripts of a text that is escaped already."""
    head, opened, tail = text.partition("^(")
    if opened and (end := _closing(tail)) is not None:
        return f"{_raised(head)}<sup>{_raised(tail[:end])}</sup>{_raised(tail[end + 1 :])}"
    return SUBSCRIPT.sub(r"\1<sub>\2</sub>", SUPERSCRIPT.sub(r"<sup>\1</sup>", text))


def _closing(text: str) -> int | None:
    """Where the parenthesis closes that was opened before the text."""
    depth = 1
    for i, character in enumerate(text):
        depth += {"(": 1, ")": -1}.get(character, 0)
        if depth == 0:
            return i
    return None


def _inline(part: str) -> str:
    if part.startswith("`"):
        return f"<code>{part[1:-1]}</code>"
    for pattern, replacement in INLINE:
        part = pattern.sub(replacement, part)
    return "".join(text if text.startswith("<") else _raised(text) for text in TAG.split(part))


def _block(block: str) -> str:
    before, *items = ITEM.split(block)
    listed = "".join(f"<li>{words(item.strip())}</li>" for item in items)
    return (f"<p>{words(before.strip())}</p>" if before.strip() else "") + (f"<ul>{listed}</ul>" if listed else "")
