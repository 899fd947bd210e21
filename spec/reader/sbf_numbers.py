"""Numbers of the format: text to binary32 and back, section 4 of sbf.md."""

import array
import math
import re
import struct
from decimal import Decimal
from fractions import Fraction

from sbf_elements import Fault

FLOAT = re.compile(rb"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
INTEGER = re.compile(rb"[+-]?[0-9]+")
BOUNDS = {"uint": (0, 2**32 - 1), "int": (-2**31, 2**31 - 1)}
SMALLEST_NORMAL = 2.0**-126


def bits_of(value):
    return struct.unpack("<I", struct.pack("<f", value))[0]


def from_bits(bits):
    return struct.unpack("<f", struct.pack("<I", bits))[0]


def nearest_exactly(word):
    """The binary32 nearest to a decimal number of moderate size, ties to even, by exact arithmetic."""
    number = abs(Fraction(Decimal(word.decode())))
    low = bits_of(min(float(number), from_bits(0x7F7FFFFF)))
    low = max(low - 1, 0)
    best = min(range(low, low + 3), key=lambda bits: (abs(Fraction(scaled(bits)) - number), bits & 1))
    return math.copysign(scaled(best), -1.0 if word.startswith(b"-") else 1.0)


def scaled(bits):
    """The value of the bits, where those of infinity stand for what would be the next number."""
    return 2.0**128 if bits == 0x7F800000 else from_bits(bits)


def read_float(word):
    """One number. Through binary64 where that cannot matter, else exactly."""
    if not FLOAT.fullmatch(word):
        raise Fault(f"'{word.decode('utf-8', 'replace')}' is not a number")
    wide = float(word)
    if wide == 0.0:
        return wide
    if not math.isfinite(wide) or abs(wide) >= 2.0**128:
        raise Fault(f"{word.decode()} is beyond what a binary32 holds")
    midway = struct.unpack("<Q", struct.pack("<d", wide))[0] & 0x1FFFFFFF == 0x10000000
    if midway or abs(wide) < SMALLEST_NORMAL:
        value = nearest_exactly(word)
    else:
        try:
            value = struct.unpack("<f", struct.pack("<f", wide))[0]
        except OverflowError:
            value = math.inf
    if abs(value) >= 2.0**128:
        raise Fault(f"{word.decode()} is beyond what a binary32 holds")
    return value


def read_floats(words):
    return [read_float(word) for word in words]


def read_integers(words, scalar):
    low, high = BOUNDS[scalar]
    numbers = []
    for word in words:
        if not INTEGER.fullmatch(word):
            raise Fault(f"'{word.decode('utf-8', 'replace')}' is not a whole number")
        digits = word.lstrip(b"+-").lstrip(b"0")
        number = int(word) if len(digits) <= 12 else high + 1
        if not low <= number <= high:
            raise Fault(f"{word[:20].decode()} is not in {low} to {high}")
        numbers.append(number)
    return numbers


def read_scalars(text, scalar):
    """The numbers of a list or a vector."""
    words = text.encode().split()
    return read_floats(words) if scalar == "float" else read_integers(words, scalar)


def print_float(value):
    """Canonical text, point 5 of section 4.2."""
    if value == 0.0:
        return "-0" if math.copysign(1.0, value) < 0 else "0"
    for digits in range(1, 10):
        text = f"{value:.{digits - 1}e}"
        try:
            if read_float(text.encode()) == value:
                break
        except Fault:  # rounded up beyond the greatest number
            continue
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


def floats_of_bytes(data):
    """Little-endian binary32 numbers as they are, infinities and NaN included."""
    numbers = array.array("f" if struct.calcsize("f") == 4 else "d")
    numbers.frombytes(data)
    if struct.pack("=H", 1) != struct.pack("<H", 1):
        numbers.byteswap()
    return numbers.tolist()


def uints_of_bytes(data):
    return list(struct.unpack(f"<{len(data) // 4}I", data))
