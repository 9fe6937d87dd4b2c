"""PNG images as rows of samples, enough to break them: 8 or 16 bits, grey or colour."""
import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3}  # by colour type


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def encode(width, height, bits, colour, pixels):
    stride = width * CHANNELS[colour] * bits // 8
    rows = b"".join(b"\0" + pixels[y * stride:(y + 1) * stride] for y in range(height))
    return (SIGNATURE + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))


def decode(data):
    """(width, height, bits, colour type, samples without filters)"""
    at, packed = len(SIGNATURE), b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        at += size + 12
    raw = zlib.decompress(packed)
    step = CHANNELS[colour] * bits // 8  # bytes a pixel
    stride = width * step
    before, pixels = bytes(stride), bytearray()
    for y in range(height):
        row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        undo_filter(raw[y * (stride + 1)], row, before, step)
        pixels += row
        before = row
    return width, height, bits, colour, bytes(pixels)


def undo_filter(kind, row, above, step):
    for i in range(len(row)):
        left = row[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + above[i]) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + above[i]) // 2) & 255
        elif kind == 4:
            guess = left + above[i] - corner
            distances = (abs(guess - left), abs(guess - above[i]), abs(guess - corner))
            row[i] = (row[i] + (left, above[i], corner)[distances.index(min(distances))]) & 255


def bomb(data):
    """The same file, whose header says 60000 x 60000 pixels."""
    header = struct.pack(">II", 60000, 60000) + data[24:29]
    return data[:8] + chunk(b"IHDR", header) + data[33:]
