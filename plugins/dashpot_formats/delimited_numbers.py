"""From texts to numbers: signs and exponents as programs write them."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot_formats.delimited_layout import NO_VALUE, is_number


def numbers_of(texts: Sequence[str], decimal: str) -> np.ndarray:
    """Numbers (n,), or an object array of numbers and of the texts that are none; what is empty is NaN."""
    found = plain_numbers(texts, decimal)
    if found is not None:
        return found
    values = numbers_and_texts(texts, decimal)
    mixed = any(isinstance(value, str) for value in values)
    return np.array(values, dtype=object if mixed else float)


def plain_numbers(texts: Sequence[str], decimal: str) -> NDArray[np.float64] | None:
    """Numbers (n,) where all texts are written plainly; None where one is not."""
    together = "\n".join(texts)
    if "_" in together or (decimal == "," and "." in together):
        return None
    try:
        return np.array(_with_plain_signs(together, decimal).split("\n"), dtype=float)
    except ValueError:
        return None


def numbers_and_texts(texts: Sequence[str], decimal: str) -> list[float | str]:
    """Each text as a number, NaN where it says that there is none, or the text as it is."""
    return [_number(text, decimal) for text in texts]


def _with_plain_signs(text: str, decimal: str) -> str:
    """Decimal points, and `E` before exponents, which Fortran writes as `D`."""
    plain = text.replace(decimal, ".")
    return re.sub(r"(?<=[0-9.])[dD](?=[-+]?[0-9])", "E", plain) if "D" in plain or "d" in plain else plain


def _number(text: str, decimal: str) -> float | str:
    text = text.strip()
    plain = _without_thousands(text, decimal)
    if is_number(plain, decimal):
        return float(_with_plain_signs(plain, decimal))
    return float("nan") if text.lower() in NO_VALUE else text


def _without_thousands(text: str, decimal: str) -> str:
    """`1.234,5` with a decimal comma is beyond doubt; `1.234` alone is not, and stays a text."""
    group = re.escape("," if decimal == "." else ".")
    written = re.fullmatch(rf"[-+]?[0-9]{{1,3}}({group}[0-9]{{3}})+{re.escape(decimal)}[0-9]+", text)
    return re.sub(group, "", text) if written else text
