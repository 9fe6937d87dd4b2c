"""Ways to break a file, by its format.

A mutation is (name, what is expected, new bytes). What is expected is one of
  BROKEN    the file says what cannot be true, or is no longer in its format: refuse it, or warn
  VALUE     another value that may be true: any answer but a crash
  HARMLESS  the same meaning in other bytes: the same answer
"""
import copy
import json
import random

import png

BROKEN, VALUE, HARMLESS = "broken", "value", "harmless"
BOM = b"\xef\xbb\xbf"
# Numbers that no field of any format allows, as a parser of text may take them.
BAD_NUMBERS = ("nan", "inf", "-1e200", "1e200", "1e999", "abc", "0x10", "")
OTHER_NUMBERS = ("0", "-1", "0.5", "1e6")


def of_any_text(data, rng, cut_is=VALUE):
    """What a text editor, a full disk or a broken copy does."""
    yield "empty", BROKEN, b""
    yield "a BOM before it", HARMLESS, BOM + data
    yield "a blank line after it", HARMLESS, data + b"\n"
    yield "no newline at its end", HARMLESS, data.rstrip(b"\n")
    yield "binary", BROKEN, rng.randbytes(512)
    yield "zeros", BROKEN, bytes(512)
    yield "a line of 1 MB", BROKEN, b"x" * (1 << 20) + b"\n"
    last = max(i for i, byte in enumerate(data) if chr(byte).isalnum())  # not in a comment at the top
    yield "not UTF-8", BROKEN, data[:last] + b"\xff\xfe" + data[last + 1:]
    yield "HTML", BROKEN, b"<!DOCTYPE html><html><body>404 Not Found</body></html>\n"
    for part in (0.2, 0.5, 0.9):
        # Cut within a line, not after one: what is left is then no record.
        cut = int(part * len(data))
        while cut > 1 and data[cut - 1:cut + 1].count(b"\n"):
            cut -= 1
        yield f"cut off at {part:.0%}", cut_is, data[:cut]
    for i in range(6):
        flipped = bytearray(data)
        for _ in range(4):
            flipped[rng.randrange(len(flipped))] ^= 1 << rng.randrange(8)
        yield f"four bits flipped ({i})", VALUE, bytes(flipped)


def of_list(data, rng):
    """`timestamp value ...` lines."""
    lines = data.decode().splitlines()
    records = [i for i, line in enumerate(lines) if line and not line.startswith("#")]

    def text(changed):
        return ("\n".join(changed) + "\n").encode()

    def with_field(line, column, value):
        changed = list(lines)
        fields = changed[line].split()
        fields[column] = value
        changed[line] = " ".join(fields)
        return text(changed)

    yield "CRLF", HARMLESS, data.replace(b"\n", b"\r\n")
    yield "tabs", HARMLESS, text([line if line.startswith("#") else line.replace(" ", "\t") for line in lines])
    yield "no records", BROKEN, text([line for line in lines if line.startswith("#")])
    yield "one record", VALUE, text([lines[records[0]]])
    yield "stamps a year later", BROKEN, text(
        [line if i not in records else shifted(line, 3.2e7) for i, line in enumerate(lines)])
    yield "reversed", VALUE, text(list(reversed(lines)))
    for _ in range(2):
        line = rng.choice(records)
        count = len(lines[line].split())
        yield f"line {line} doubled", BROKEN, text(lines[:line] + [lines[line]] + lines[line:])
        yield f"line {line} left out", VALUE, text(lines[:line] + lines[line + 1:])
        yield f"line {line} without its last column", BROKEN, text(
            lines[:line] + [" ".join(lines[line].split()[:-1])] + lines[line + 1:])
        yield f"line {line} with a column more", VALUE, text(lines[:line] + [lines[line] + " 7"] + lines[line + 1:])
        yield f"line {line} with a stamp of 1 h", VALUE, with_field(line, 0, "3600.0")
        yield f"line {line} with a negative stamp", VALUE, with_field(line, 0, "-5")
        for value in BAD_NUMBERS[:-1]:
            column = rng.randrange(count)
            yield f"line {line} column {column} = {value}", BROKEN, with_field(line, column, value)
        if count == 8:
            yield f"line {line} a quaternion of length 10", BROKEN, text(
                lines[:line] + [" ".join(lines[line].split()[:4] + ["10", "0", "0", "0"])] + lines[line + 1:])
            yield f"line {line} a quaternion of zeros", BROKEN, text(
                lines[:line] + [" ".join(lines[line].split()[:4] + ["0"] * 4)] + lines[line + 1:])
            yield f"line {line} 3 m away", VALUE, with_field(line, 1, "3")
        else:
            yield f"line {line} names no file", BROKEN, with_field(line, 1, "rgb/none.png")
            yield f"line {line} names a folder", BROKEN, with_field(line, 1, "rgb")
            yield f"line {line} names a device", BROKEN, with_field(line, 1, "/dev/zero")


def shifted(line, seconds):
    fields = line.split()
    return " ".join(f"{float(f) + seconds:.6f}" if i in (0, 2) and not f.endswith("png") and
                    (i == 0 or len(fields) == 4) else f for i, f in enumerate(fields))


def leaves(node, path=()):
    """All places of a tree of JSON or YAML values, inner ones too."""
    if path:
        yield path
    if isinstance(node, dict):
        for key in node:
            yield from leaves(node[key], path + (key,))
    elif isinstance(node, list):
        for i in range(len(node)):
            yield from leaves(node[i], path + (i,))


def at(node, path):
    for step in path:
        node = node[step]
    return node


def changed(tree, path, value):
    tree = copy.deepcopy(tree)
    at(tree, path[:-1])[path[-1]] = value
    return tree


def without(tree, path):
    tree = copy.deepcopy(tree)
    del at(tree, path[:-1])[path[-1]]
    return tree


def name_of(path):
    return "/" + "/".join(map(str, path))


def general(path):
    """The place without its indices: such places are one kind."""
    return tuple("*" if isinstance(step, int) else step for step in path)


def of_tree(tree, rng, places):
    """Changed values in a tree of JSON: (name, expectation, tree)."""
    by_kind = {}
    for path in leaves(tree):
        by_kind.setdefault(general(path), []).append(path)
    kinds = list(by_kind)
    rng.shuffle(kinds)
    for kind in kinds[:places]:
        path = rng.choice(by_kind[kind])
        old = at(tree, path)
        where = name_of(path)
        yield f"{where} left out", VALUE if isinstance(path[-1], int) else BROKEN, without(tree, path)
        yield f"{where} = null", BROKEN, changed(tree, path, None)
        if isinstance(old, bool) or not isinstance(old, (int, float)):
            yield f"{where} = 7", BROKEN, changed(tree, path, 7)
        if isinstance(old, (int, float)) and not isinstance(old, bool):
            yield f"{where} = text", BROKEN, changed(tree, path, "abc")
            yield f"{where} = NaN", BROKEN, changed(tree, path, float("nan"))
            yield f"{where} = 1e200", BROKEN, changed(tree, path, 1e200)
            yield f"{where} = -3", VALUE, changed(tree, path, -3)
            yield f"{where} = 0", VALUE, changed(tree, path, 0)
        if isinstance(old, str):
            yield f"{where} = an unknown word", VALUE, changed(tree, path, "unknown word")
        if isinstance(old, list):
            yield f"{where} = []", VALUE, changed(tree, path, [])
            yield f"{where} with its first twice", VALUE, changed(tree, path, old[:1] + old)
            yield f"{where} an object", BROKEN, changed(tree, path, {"a": 1})
        if isinstance(old, dict):
            yield f"{where} = {{}}", VALUE, changed(tree, path, {})
            yield f"{where} a list", BROKEN, changed(tree, path, [1, 2])


def of_json(data, rng, places=18):
    tree = json.loads(data)
    yield "an unknown key", HARMLESS, json.dumps({**tree, "x_unknown": 1}, indent=1).encode()
    yield "one line", HARMLESS, json.dumps(tree).encode()
    yield "CRLF", HARMLESS, data.replace(b"\n", b"\r\n")
    yield "a list", BROKEN, b"[1, 2, 3]"
    yield "a number", BROKEN, b"7"
    yield "100000 brackets", BROKEN, b"[" * 100000
    yield "text after it", BROKEN, data + b"xyz"
    for name, expected, broken in of_tree(tree, rng, places):
        yield name, expected, json.dumps(broken, indent=1).encode()


def of_jsonl(data, rng, places=14):
    lines = data.decode().splitlines()
    records = [json.loads(line) for line in lines]
    text = lambda changed: ("\n".join(changed) + "\n").encode()
    n = rng.randrange(1, len(lines))
    yield "CRLF", HARMLESS, data.replace(b"\n", b"\r\n")
    yield f"line {n + 1} doubled", BROKEN, text(lines[:n] + [lines[n]] + lines[n:])
    yield f"line {n + 1} left out", VALUE, text(lines[:n] + lines[n + 1:])
    yield f"line {n + 1} blank", VALUE, text(lines[:n] + [""] + lines[n + 1:])
    yield f"line {n + 1} cut in half", BROKEN, text(lines[:n] + [lines[n][:len(lines[n]) // 2]] + lines[n + 1:])
    yield f"line {n + 1} a list", BROKEN, text(lines[:n] + ["[1]"] + lines[n + 1:])
    yield "stamps a year later", BROKEN, text(
        [json.dumps({**r, "timestamp": r["timestamp"] + 3.2e7}) for r in records])
    yield "stamp of no frame", BROKEN, text(
        lines[:n] + [json.dumps({**records[n], "timestamp": records[n]["timestamp"] + 0.01})] + lines[n + 1:])
    yield "reversed", VALUE, text(list(reversed(lines)))
    for name, expected, broken in of_tree(records[n], rng, places):
        yield f"line {n + 1} {name}", expected, text(lines[:n] + [json.dumps(broken)] + lines[n + 1:])


def of_yaml(data, rng, places=24):
    """Changed scalars, line by line: `key: value`, in whatever style it is written."""
    lines = data.decode().splitlines()
    scalars = [i for i, line in enumerate(lines)
               if ":" in line and line.split(":", 1)[1].strip() and not line.lstrip().startswith("#")]

    def with_value(line, value):
        key = lines[line].split(":", 1)[0]
        return ("\n".join(lines[:line] + [f"{key}: {value}"] + lines[line + 1:]) + "\n").encode()

    yield "CRLF", HARMLESS, data.replace(b"\n", b"\r\n")
    yield "a comment", HARMLESS, b"# comment\n" + data
    yield "an unknown key", BROKEN, data + b"\nx_unknown: 1\n"
    yield "a list", BROKEN, b"- 1\n- 2\n"
    yield "a tab as indent", BROKEN, data + b"\nx:\n\ty: 1\n"
    yield "an anchor of itself", BROKEN, b"a: &a [*a]\n"
    yield "aliases by the billion", BROKEN, b"a: &a [x,x,x,x,x,x,x,x,x]\n" + b"".join(
        f"{chr(98 + i)}: &{chr(98 + i)} [{','.join(['*' + chr(97 + i)] * 9)}]\n".encode() for i in range(9))
    yield "10000 brackets", BROKEN, b"a: " + b"[" * 10000
    for line in rng.sample(scalars, min(places, len(scalars))):
        value = lines[line].split(":", 1)[1].strip()
        where = f"line {line + 1} ({lines[line].split(':', 1)[0].strip(' -')})"
        yield f"{where} left out", BROKEN, ("\n".join(lines[:line] + lines[line + 1:]) + "\n").encode()
        yield f"{where} twice", BROKEN, ("\n".join(lines[:line + 1] + lines[line:]) + "\n").encode()
        number = value.replace(".", "").replace("-", "").replace("e", "").isdigit()
        if number:
            for bad in (".nan", ".inf", "1e200", "abc", "", "[1, 2]"):
                yield f"{where} = {bad}", BROKEN, with_value(line, bad)
            for other in OTHER_NUMBERS:
                yield f"{where} = {other}", VALUE, with_value(line, other)
        else:
            yield f"{where} = {{}}", BROKEN, with_value(line, "{}")
            yield f"{where} = 7", VALUE, with_value(line, "7")
            yield f"{where} = nan", VALUE, with_value(line, ".nan")


def of_csv(data, rng):
    lines = data.decode().splitlines()
    text = lambda changed: ("\n".join(changed) + "\n").encode()
    yield "CRLF", HARMLESS, data.replace(b"\n", b"\r\n")
    yield "no header", BROKEN, text(lines[1:])
    yield "header alone", VALUE, text(lines[:1])
    yield "an unknown column", VALUE, text([lines[0] + ",x"] + [line + ",1" for line in lines[1:]])
    line = rng.randrange(1, len(lines))
    yield f"line {line + 1} doubled", BROKEN, text(lines[:line] + [lines[line]] + lines[line:])
    yield f"line {line + 1} a column less", BROKEN, text(
        lines[:line] + [lines[line].rsplit(",", 1)[0]] + lines[line + 1:])
    for value in BAD_NUMBERS:
        fields = lines[line].split(",")
        fields[rng.randrange(len(fields))] = value
        yield f"line {line + 1} a field = `{value}`", BROKEN, text(lines[:line] + [",".join(fields)] + lines[line + 1:])


def of_png(data, rng, ids):
    """@param ids: the pixels are ids of things, so that an unknown one is wrong."""
    width, height, bits, colour, pixels = png.decode(data)
    yield "empty", BROKEN, b""
    yield "text", BROKEN, b"not an image\n"
    yield "a BMP header", BROKEN, b"BM" + data[2:]
    yield "cut in half", BROKEN, data[:len(data) // 2]
    yield "header alone", BROKEN, data[:33]
    yield "60000 x 60000 by its header", BROKEN, png.bomb(data)
    flipped = bytearray(data)
    flipped[len(data) // 2] ^= 0x55
    yield "a byte of its middle flipped", BROKEN, bytes(flipped)
    yield "packed otherwise", HARMLESS, png.encode(width, height, bits, colour, pixels)
    step = png.CHANNELS[colour] * bits // 8
    half = b"".join(pixels[y * width * step:][:width // 2 * step] for y in range(height // 2))
    yield "half as wide and high", BROKEN, png.encode(width // 2, height // 2, bits, colour, half)
    yield "1 x 1", BROKEN, png.encode(1, 1, bits, colour, pixels[:step])
    yield "all zero", VALUE, png.encode(width, height, bits, colour, bytes(len(pixels)))
    if bits == 16:
        yield "8 bits", BROKEN, png.encode(width, height, 8, 0, pixels[1::2])
        yield "all 65535", VALUE, png.encode(width, height, 16, 0, b"\xff" * len(pixels))
    elif colour == 0:
        yield "16 bits", BROKEN, png.encode(width, height, 16, 0, b"".join(bytes((0, p)) for p in pixels))
    else:
        yield "grey", VALUE, png.encode(width, height, 8, 0, pixels[::3])
        yield "noise", VALUE, png.encode(width, height, 8, 2, rng.randbytes(len(pixels)))
    if ids:
        unknown = bytearray(pixels)
        for y in range(height // 4, height // 2):
            row = y * width * step
            unknown[row:row + width // 2 * step] = (b"\xfe\xfd"[:step]) * (width // 2)
        yield "a block of unknown ids", BROKEN, png.encode(width, height, bits, colour, bytes(unknown))


def of_format(kind, data, rng):
    """All mutations of one file."""
    if kind in ("depth", "colour", "ids"):
        yield from of_png(data, rng, kind == "ids")
        return
    # JSON that is cut off is never JSON; a list or YAML may end anywhere.
    yield from of_any_text(data, rng, BROKEN if kind in ("json", "jsonl") else VALUE)
    yield from {"list": of_list, "json": of_json, "jsonl": of_jsonl, "yaml": of_yaml, "csv": of_csv,
                "text": lambda *_: ()}[kind](data, rng)
