"""Formats numbers as in the canonical form: section 4.2 of spec/sbf.md, point 5."""

import math
import struct
from array import array
from fractions import Fraction

TIE, BELOW = 0x10000000, 0x1FFFFFFF  # the bits of a binary64 that a binary32 drops, and those of half a step


def float_words(values):
    """The texts of an `array("f")`: fewest digits that read back as the same number."""
    if not values:
        return []
    words = ("%.6g " * len(values) % tuple(values)).split()
    todo = unequal(words, values)
    for digits in (7, 8, 9):
        longer = [f"{values[i]:.{digits}g}" for i in todo]
        for i, word in zip(todo, longer):
            words[i] = word
        wrong = unequal(longer, [values[i] for i in todo])
        todo = [todo[i] for i in wrong]
    for i, value in enumerate(values):
        size = -value if value < 0.0 else value
        if size >= 1e5 or 0.0 < size < 1e-3 and (size >= 9e-5 or size < 1.2e-38):
            words[i] = float_word(value)  # where C's %g would choose the other notation, or a binary64 is too coarse
    return words


def unequal(words, values):
    """Indices of the texts that do not read back as the same number, or may not: the binary64 is halfway between two binary32."""
    doubles = array("d", map(float, words))
    bits = array("Q", doubles.tobytes())
    back = array("f", doubles)
    return [i for i, (a, b, wide) in enumerate(zip(back, values, bits)) if a != b or wide & BELOW == TIE]


def float_word(value):
    """One number, by exact comparison."""
    value = struct.unpack("<f", struct.pack("<f", value))[0]
    if not math.isfinite(value):
        raise ValueError(f"{value} is not a finite number")
    if value == 0.0:
        return "-0" if math.copysign(1.0, value) < 0 else "0"
    text = next(text for text in (f"{value:.{digits}e}" for digits in range(9)) if reads_back(text, value))
    mantissa, exponent = text.split("e")
    sign, mantissa = ("-", mantissa[1:]) if mantissa[0] == "-" else ("", mantissa)
    figures = mantissa.replace(".", "").rstrip("0") or "0"
    power = int(exponent)
    scientific = figures[0] + ("." + figures[1:] if len(figures) > 1 else "")
    scientific += f"e{'-' if power < 0 else '+'}{abs(power):02d}"
    if power >= len(figures) - 1:
        plain = str(int(abs(value)))
    elif power >= 0:
        plain = figures[:power + 1] + "." + figures[power + 1:]
    else:
        plain = "0." + "0" * (-power - 1) + figures
    return sign + (plain if len(plain) <= len(scientific) else scientific)


def reads_back(text, value):
    """Whether a correct reader reads the text as this binary32: the text is closer to it than to both neighbours."""
    number, bits = abs(Fraction(text)), struct.unpack("<I", struct.pack("<f", abs(value)))[0]
    own = Fraction(of_bits(bits))
    near = [abs(number - own)] + [abs(number - Fraction(of_bits(other))) for other in (bits - 1, bits + 1) if other >= 0]
    return near[0] < min(near[1:]) or near[0] == min(near[1:]) and bits % 2 == 0


def of_bits(bits):
    """The value of the bits; infinity is replaced by the next number of the same spacing."""
    return 2.0**128 if bits == 0x7F800000 else struct.unpack("<f", struct.pack("<I", bits))[0]


def number_words(values):
    """The texts of an `array` of numbers."""
    if values.typecode == "f":
        return float_words(values)
    return list(map(str, values))


def nine_digits(values):
    """One text of numbers that read back as the same. Most are longer than necessary."""
    return ("%.9g " * len(values) % tuple(values))[:-1] if values.typecode == "f" else " ".join(map(str, values))
