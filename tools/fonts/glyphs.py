#!/usr/bin/python3
"""Write examples/common/glyphs.inc from the console fonts of Debian's package fonts-spleen:
    tools/fonts/glyphs.py /usr/share/consolefonts > examples/common/glyphs.inc"""
import gzip
import struct
import sys

LICENCE = """// The fonts Spleen 8x16 and 12x24 (Basic Latin to Latin Extended-A), one line per character: code point, then the rows
// from the top, the leftmost pixel in the highest bit. Written by tools/fonts/glyphs.py from Debian's fonts-spleen 1.9.1.
//
// Copyright (c) 2018-2020, Frederic Cambus. All rights reserved. Redistribution and use in source and binary forms, with
// or without modification, are permitted provided that the following conditions are met:
// - Redistributions of source code must retain the above copyright notice, this list of conditions and the following
//   disclaimer.
// - Redistributions in binary form must reproduce the above copyright notice, this list of conditions and the following
//   disclaimer in the documentation and/or other materials provided with the distribution.
// THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS "AS IS" AND ANY EXPRESS OR IMPLIED WARRANTIES,
// INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE
// DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT HOLDER OR CONTRIBUTORS BE LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL,
// SPECIAL, EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR
// SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY,
// WHETHER IN CONTRACT, STRICT LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE OF
// THIS SOFTWARE, EVEN IF ADVISED OF THE POSSIBILITY OF SUCH DAMAGE.
"""


def shapes(path):
    """Code point -> rows, from a PC Screen Font of version 1 (8 pixels wide) or 2, with a Unicode table."""
    data = gzip.open(path).read()
    if data[:2] == b"\x36\x04":
        header, count, size, height, width = 4, 512 if data[2] & 1 else 256, data[3], data[3], 8
        entries = data[header + count * size:].decode("utf-16-le", "surrogatepass").split("\uffff")
        letters = [entry.split("\ufffe")[0] for entry in entries]
    else:
        magic, _, header, _, count, size, height, width = struct.unpack("<8I", data[:32])
        assert magic == 0x864AB572, f"{path} is no PC Screen Font"
        letters = [entry.split(b"\xfe")[0].decode() for entry in data[header + count * size:].split(b"\xff")]
    stride = (width + 7) // 8
    found = {}
    for index in range(count):
        raw = data[header + index * size:header + (index + 1) * size]
        rows = [int.from_bytes(raw[row * stride:(row + 1) * stride], "big") for row in range(height)]
        for letter in letters[index]:
            found[ord(letter)] = rows
    return found


def main():
    print(LICENCE)
    for name, size, type_name, digits in (("small_font", "8x16", "uint8_t", 2), ("large_font", "12x24", "uint16_t", 4)):
        found = shapes(f"{sys.argv[1]}/spleen-{size}.psfu.gz")
        width, height = (int(side) for side in size.split("x"))
        codes = [code for code in range(0x20, 0x180) if code in found and not 0x7F <= code < 0xA0]
        print(f"constexpr Glyph<{type_name}, {height}> {name}[] = {{ // {width}x{height}")
        for code in codes:
            print(f"    {{0x{code:04x}, {{" + ", ".join(f"0x{row:0{digits}x}" for row in found[code]) + "}},")
        print("};\n")


main()
