"""Point cache files: positions of points in every frame, as .pc2 (little-endian, by frames) or .mdd (big-endian, by seconds)."""

import os
import struct

import numpy

PC2_HEADER = struct.Struct("<12siiffi")  # magic, version, points, first frame, frames a sample, samples
MDD_HEADER = struct.Struct(">ii")        # samples, points


class CacheWriter:
    """Writes a temporary file beside the path. `close` moves it there when all frames are in; `drop` deletes it."""

    def __init__(self, path, points, samples, start, rate):
        self.path, self.temporary, self.points = path, f"{path}.unfinished", points
        self.is_mdd = path.endswith(".mdd")
        self.file = open(self.temporary, "wb")  # pylint: disable=consider-using-with
        try:
            if self.is_mdd:
                self.file.write(MDD_HEADER.pack(samples, points))
                self.file.write((numpy.arange(samples) / rate).astype(">f4").tobytes())
            else:
                self.file.write(PC2_HEADER.pack(b"POINTCACHE2\0", 1, points, start, 1.0, samples))
        except OSError:
            self.drop()
            raise

    def write(self, positions):
        """Writes one frame: an (n, 3) array."""
        self.file.write(numpy.ascontiguousarray(positions).astype(">f4" if self.is_mdd else "<f4").tobytes())

    def close(self):
        self.file.close()
        os.replace(self.temporary, self.path)

    def drop(self):
        self.file.close()
        if os.path.exists(self.temporary):
            os.unlink(self.temporary)


def read_cache(path):
    """The positions as a (samples, points, 3) array."""
    with open(path, "rb") as file:
        data = file.read()
    if path.endswith(".mdd"):
        samples, points = MDD_HEADER.unpack_from(data)
        found = numpy.frombuffer(data, dtype=">f4", offset=MDD_HEADER.size + 4 * samples)
    else:
        magic, _, points, _, _, samples = PC2_HEADER.unpack_from(data)
        if magic != b"POINTCACHE2\0":
            raise ValueError(f"{path} is not a point cache")
        found = numpy.frombuffer(data, dtype="<f4", offset=PC2_HEADER.size)
    return found[:3 * samples * points].reshape(samples, points, 3)


def cut_cache(path, new_path, first, count, start, rate):
    """Writes a cache with `count` samples, starting at sample `first`."""
    frames = read_cache(path)[first:first + count]
    writer = CacheWriter(new_path, frames.shape[1], len(frames), start, rate)
    try:
        for positions in frames:
            writer.write(positions)
    except BaseException:
        writer.drop()
        raise
    writer.close()
