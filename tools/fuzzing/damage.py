"""Random damage to the bytes of a file."""
import re

WORDS = (b"nan", b"-nan", b"inf", b"1e999", b"-1", b"0", b"4294967295", b"2147483648", b"9223372036854775807",
         b"1e-320", b"", b"x", b"1e30")
INTEGERS = (0, 1, 0x7F, 0x80, 0xFF, 0x7FFFFFFF, 0xFFFFFFFF, 1 << 40, (1 << 63) - 1, (1 << 64) - 1)


def somewhere(rng, data):
    """Random position; every second time near the beginning, where files store counts and sizes."""
    end = len(data) if rng.random() < 0.5 else min(len(data), 400)
    return rng.randrange(end) if end else 0


def flip_bit(rng, data):
    at, bit = somewhere(rng, data), 1 << rng.randrange(8)
    return data[:at] + bytes(byte ^ bit for byte in data[at:at + 1]) + data[at + 1:]


def set_bytes(rng, data):
    at, size = somewhere(rng, data), rng.choice([1, 2, 16, 300])
    return data[:at] + bytes(rng.randrange(256) for _ in range(size)) + data[at + size:]


def zero_bytes(rng, data):
    at, size = somewhere(rng, data), rng.choice([1, 8, 64, 4096])
    return data[:at] + bytes(min(size, len(data) - at)) + data[at + size:]


def set_integer(rng, data):
    at, size = somewhere(rng, data), rng.choice([4, 8])
    return data[:at] + (rng.choice(INTEGERS) & ((1 << 8 * size) - 1)).to_bytes(size, "little") + data[at + size:]


def truncate(rng, data):
    return data[:rng.choice([0, len(data) // 2, somewhere(rng, data), max(0, len(data) - 1)])]


def cut_out(rng, data):
    at = somewhere(rng, data)
    return data[:at] + data[at + rng.choice([1, 7, 64, 1000]):]


def repeat(rng, data):
    at, size = somewhere(rng, data), rng.choice([1, 8, 100, 2000])
    return data[:at + size] + data[at:]


def append(rng, data):
    return data + rng.choice([b"\0" * 100, b"\n", data, b"rubbish"])


def set_word(rng, data):
    """Replaces a number in a text by another one."""
    words = list(re.finditer(rb"[-+]?[0-9][-+0-9.eE]*", data[:200000]))
    if not words:
        return flip_bit(rng, data)
    word = rng.choice(words if rng.random() < 0.6 else words[:12])
    return data[:word.start()] + rng.choice(WORDS) + data[word.end():]


def swap_lines(rng, data):
    lines = data.split(b"\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[i], lines[j] = lines[j], lines[i]
    return b"\n".join(lines)


def drop_line(rng, data):
    lines = data.split(b"\n")
    del lines[rng.randrange(len(lines))]
    return b"\n".join(lines)


BYTES = (flip_bit, set_bytes, zero_bytes, set_integer, truncate, cut_out, repeat, append)
TEXT = (set_word, set_word, set_word, swap_lines, drop_line)


def damage(rng, data, text=False):
    """(description, damaged bytes) after one to three kinds of damage."""
    out, done = data, []
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        way = rng.choice(BYTES + TEXT * text)
        out = way(rng, out)
        done.append(way.__name__)
    if out == data:
        return damage(rng, data, text) if data else ("append", b"rubbish")
    return "+".join(done), out
