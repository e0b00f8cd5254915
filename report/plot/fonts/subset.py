#!/usr/bin/python3
# Maker of the fonts in this folder: subsets of Liberation Sans under another name, for the text of figures.
#
#   apt-get install fonts-liberation2 python3-fonttools     (Debian 12: 2.1.5 and 4.38)
#   report/plot/fonts/subset.py
#
# writes GaitlabSans.ttf and GaitlabSans-Bold.ttf; the same packages produce the same bytes. The licence of Liberation Sans (OFL.txt)
# reserves the names Liberation, Arimo, Tinos and Cousine, so that a subset needs another name. Debian's package fonts-liberation is
# an older version under the GPL.
import pathlib

from fontTools import subset
from fontTools.ttLib import TTFont
from fontTools.ttLib.tables._c_m_a_p import CmapSubtable
from fontTools.ttLib.tables._g_l_y_f import Glyph, GlyphComponent

SOURCE = pathlib.Path("/usr/share/fonts/truetype/liberation2")
FOLDER = pathlib.Path(__file__).parent
NAME = "Gaitlab Sans"

CHARACTERS = [
    *range(0x20, 0x7F),
    *range(0xA0, 0x180),  # Latin-1, Latin Extended-A
    0x192, 0x2C6, 0x2C7, *range(0x2D8, 0x2DE),
    *range(0x384, 0x3D7),  # Greek
    0x2010, *range(0x2012, 0x2016), *range(0x2018, 0x201F), 0x2020, 0x2021, 0x2022, 0x2026, 0x2030, 0x2032, 0x2033, 0x2039, 0x203A,
    *range(0x2070, 0x208F),  # superscripts and subscripts
    0x20AC, 0x2113, 0x2122, 0x2126,
    *range(0x2190, 0x2196),  # arrows
    0x2202, 0x2206, 0x220F, 0x2211, 0x2212, 0x2215, 0x2219, 0x221A, 0x221E, 0x222B, 0x2248, 0x2260, 0x2261, 0x2264, 0x2265,
    0x25CA, 0x25CB, 0x25CF,
]  # fmt: skip
# Characters that Liberation Sans lacks, as scaled copies: code, source, scale, shift upwards in units of the font.
SCALED = [(0x2070, "zero", 0.6, 580), (0x207B, "minus", 0.6, 620), (0x208B, "minus", 0.6, -280), (0x202F, "space", 0.6, 0)]
# Spaces and hyphens that look like others.
SAME = {0x2009: 0x202F, 0x2011: 0x2010}


def subset_of(font):
    """Removes all other characters, hinting and layout tables."""
    options = subset.Options()
    options.hinting = False
    options.layout_features = []
    options.notdef_outline = True
    options.glyph_names = False
    options.name_IDs = []
    options.drop_tables += ["FFTM", "GDEF", "GPOS", "GSUB", "GlyphOrder", "kern", "gasp"]
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=CHARACTERS)
    subsetter.subset(font)


def scaled_glyph(font, source, scale, up):
    glyph = Glyph()
    glyph.numberOfContours = -1
    part = GlyphComponent()
    part.glyphName, part.x, part.y, part.flags = source, 0, up, 0x0002
    part.transform = [[scale, 0], [0, scale]]
    glyph.components = [part]
    return glyph


def add_scaled(font, characters):
    for code, source, scale, up in SCALED:
        name = f"uni{code:04X}"
        font.setGlyphOrder([*font.getGlyphOrder(), name])
        width, bearing = font["hmtx"][source]
        font["hmtx"][name] = (round(width * scale), round(bearing * scale))
        font["glyf"][name] = Glyph() if source == "space" else scaled_glyph(font, source, scale, up)
        characters[code] = name


def set_characters(font, characters):
    """Writes a table of characters in format 12, which report/plot/font.cpp reads."""
    table = CmapSubtable.newSubtable(12)
    table.platformID, table.platEncID, table.language, table.cmap = 3, 10, 0, characters
    font["cmap"].tables = [table]


def set_names(font, style):
    name = font["name"]
    name.names = []
    full = NAME if style == "Regular" else f"{NAME} {style}"
    written = full.replace(" ", "", 1).replace(" ", "-")
    texts = {
        0: "Digitized data copyright (c) 2010 Google Corporation with Reserved Font Arimo, Tinos and Cousine. "
           "Copyright (c) 2012 Red Hat, Inc. with Reserved Font Name Liberation.",
        1: NAME, 2: style, 3: f"{written}, subset of version 2.1.5 of its source", 4: full, 5: "Version 2.1.5; subset 1", 6: written,
        13: "This Font Software is licensed under the SIL Open Font License, Version 1.1.", 14: "https://openfontlicense.org",
    }  # fmt: skip
    for number, text in texts.items():
        name.setName(text, number, 3, 1, 0x409)
    return written


def make(style):
    font = TTFont(SOURCE / f"LiberationSans-{style}.ttf", recalcTimestamp=False)
    subset_of(font)
    characters = dict(font.getBestCmap())
    add_scaled(font, characters)
    for code, like in SAME.items():
        characters[code] = characters[like]
    set_characters(font, characters)
    file = FOLDER / f"{set_names(font, style)}.ttf"
    font.save(file)
    print(f"{file.name}: {len(characters)} characters, {file.stat().st_size} bytes")


for style in ("Regular", "Bold"):
    make(style)
