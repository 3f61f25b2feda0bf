"""The same as waves.cpp, in Python, by ctypes and without further packages.

Usage: waves.py [FRAMES [PORT]]
The variable IMGEO_LIVE_LIBRARY names libimgeo-live.so where the system does not find it.
"""

import array
import ctypes
import math
import os
import sys
import time

COLUMNS, ROWS, FRAMES_PER_SECOND = 64, 64, 20


class Totals(ctypes.Structure):
    _fields_ = [(name, ctypes.c_uint64) for name in ("published", "dropped", "clamped", "bytes")]


class Publisher:
    """A live stream with its own server (imgeo/live_c.h)."""

    def __init__(self, name, columns, rows, box, rate, port):
        library = ctypes.CDLL(os.environ.get("IMGEO_LIVE_LIBRARY", "libimgeo-live.so"))
        library.imgeo_publisher_create.restype = ctypes.c_void_p
        library.imgeo_publisher_create.argtypes = [
            ctypes.c_char_p, ctypes.c_uint32, ctypes.c_uint32, ctypes.c_double * 6]
        library.imgeo_publisher_set_rate.argtypes = [ctypes.c_void_p, ctypes.c_double]
        library.imgeo_publisher_listen.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_uint16]
        library.imgeo_publisher_publish.argtypes = [ctypes.c_void_p, ctypes.c_double] + [ctypes.c_void_p] * 4
        library.imgeo_publisher_url.restype = ctypes.c_char_p
        library.imgeo_publisher_url.argtypes = [ctypes.c_void_p]
        library.imgeo_publisher_error.restype = ctypes.c_char_p
        library.imgeo_publisher_totals.restype = Totals
        library.imgeo_publisher_totals.argtypes = [ctypes.c_void_p]
        library.imgeo_publisher_destroy.argtypes = [ctypes.c_void_p]
        self.library = library
        self.vertices = columns * rows
        self.handle = library.imgeo_publisher_create(
            name.encode(), self.vertices, columns, (ctypes.c_double * 6)(*box))
        self.check(library.imgeo_publisher_set_rate(self.handle, rate))
        self.check(library.imgeo_publisher_listen(self.handle, b"127.0.0.1", port))

    def check(self, code):
        if code != 0:
            raise RuntimeError(self.library.imgeo_publisher_error().decode())

    def publish(self, positions):
        """Publishes array("f") of x y z of each vertex."""
        if len(positions) != 3 * self.vertices:
            raise ValueError(f"{len(positions)} coordinates instead of {3 * self.vertices}")
        address, _ = positions.buffer_info()
        self.check(self.library.imgeo_publisher_publish(self.handle, math.nan, address, None, None, None))

    @property
    def url(self):
        return self.library.imgeo_publisher_url(self.handle).decode()

    @property
    def totals(self):
        return self.library.imgeo_publisher_totals(self.handle)

    def close(self):
        self.library.imgeo_publisher_destroy(self.handle)
        self.handle = None


def positions_at(seconds):
    positions = array.array("f")
    for row in range(ROWS):
        z = 2 * row / (ROWS - 1) - 1
        for column in range(COLUMNS):
            x = 2 * column / (COLUMNS - 1) - 1
            positions.extend((x, 0.2 * math.sin(5 * x + 2 * seconds) * math.cos(4 * z - seconds), z))
    return positions


def main():
    frames = int(sys.argv[1]) if len(sys.argv) > 1 else 600 * FRAMES_PER_SECOND
    port = int(sys.argv[2]) if len(sys.argv) > 2 else 8090
    publisher = Publisher("waves", COLUMNS, ROWS, (-1, -0.25, -1, 1, 0.25, 1), FRAMES_PER_SECOND, port)
    print(publisher.url, flush=True)
    for frame in range(frames):
        publisher.publish(positions_at(frame / FRAMES_PER_SECOND))
        time.sleep(1 / FRAMES_PER_SECOND)
    totals = publisher.totals
    print(f"{totals.published} frames, {totals.bytes // max(1, totals.published)} bytes each")
    publisher.close()


if __name__ == "__main__":
    main()
