#!/usr/bin/env python3
"""Makes the packed files of invalid/ from valid/jelly.sbf: packs it with the program sbfmt, whose path is the one
argument, and damages one thing in each. Run it again only when the packed form changes; the files are committed, for
another zlib packs to other bytes."""

import os
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
ENTRY, FIRST_ENTRY = 64, 64
# Fields of the header and of a table entry, as spec/packed.md numbers them.
LEAST_MINOR, TABLE_CRC, HEADER_CRC = 14, 44, 60
KIND, CODEC, OFFSET, STORED_SIZE, RAW_SIZE, COUNT, CRC = 0, 17, 24, 32, 40, 48, 56


def get(data, at, form):
    return struct.unpack_from("<" + form, data, at)[0]


def put(data, at, form, value):
    struct.pack_into("<" + form, data, at, value)


def chunk_count(data):
    return get(data, 40, "I")


def entry(number):
    return FIRST_ENTRY + number * ENTRY


def seal(data):
    """Makes every checksum that of the bytes as they are, so that a reader gets to what is wrong."""
    for number in range(chunk_count(data)):
        begin, size = get(data, entry(number) + OFFSET, "Q"), get(data, entry(number) + STORED_SIZE, "Q")
        put(data, entry(number) + CRC, "I", zlib.crc32(bytes(data[begin:begin + size])))
    put(data, TABLE_CRC, "I", zlib.crc32(bytes(data[FIRST_ENTRY:entry(chunk_count(data))])))
    put(data, HEADER_CRC, "I", zlib.crc32(bytes(data[:HEADER_CRC])))
    return data


def compressed(data):
    """A chunk that zlib has packed, as its number."""
    return next(number for number in range(chunk_count(data)) if data[entry(number) + CODEC] == 1)


def line_ends_converted(data):
    return data.replace(b"\r\n", b"\n", 1)


def cut_short(data):
    return data[:len(data) * 2 // 3]


def count_wrong(data):
    put(data, entry(1) + COUNT, "Q", get(data, entry(1) + COUNT, "Q") + 1)
    return seal(data)


def byte_changed(data):
    data[get(data, entry(1) + OFFSET, "Q") + 5] ^= 0x10
    return data


def stream_broken(data):
    data[get(data, entry(compressed(data)) + OFFSET, "Q") + 2] ^= 0xff
    return seal(data)


def bomb(data):
    at = entry(compressed(data))
    size = get(data, at + STORED_SIZE, "Q") * 2000
    put(data, at + RAW_SIZE, "Q", size)
    put(data, at + COUNT, "Q", size)
    return seal(data)


def form_wrong(data):
    put(data, get(data, entry(0) + OFFSET, "Q") + 2, "H", 99)
    return seal(data)


def codec_unknown(data):
    data[entry(1) + CODEC] = 9
    return seal(data)


def kind_unknown(data):
    at = entry(chunk_count(data) - 1) + KIND
    data[at:at + 4] = b"WOOF"
    return seal(data)


def control_character(data):
    at = data.index(b"Jelly on a stick")
    data[at] = 1
    return seal(data)


def reader_too_old(data):
    put(data, 10, "H", 99)
    put(data, LEAST_MINOR, "H", 99)
    return seal(data)


# Name of the file, whether the chunks are stored as they are, what happens to it.
FAULTS = (("packed_magic", False, line_ends_converted), ("packed_truncated", False, cut_short),
          ("packed_table", False, count_wrong), ("packed_crc", False, byte_changed),
          ("packed_inflate", False, stream_broken), ("packed_ratio", False, bomb), ("packed_record", True, form_wrong),
          ("packed_codec", False, codec_unknown), ("packed_unknown_part", False, kind_unknown),
          ("bad_text", True, control_character), ("packed_version_too_new", False, reader_too_old))


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name, stored, damage in FAULTS:
            path = os.path.join(folder, "jelly.sbfz")
            subprocess.run([sys.argv[1], "pack", os.path.join(HERE, "valid", "jelly.sbf"), "-o", path,
                            *(["--store"] if stored else [])], check=True)
            with open(path, "rb") as stream:
                data = bytearray(stream.read())
            with open(os.path.join(HERE, "invalid", name + ".sbfz"), "wb") as stream:
                stream.write(damage(data))


if __name__ == "__main__":
    main()
