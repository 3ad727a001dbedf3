"""Names of people in Latin letters, and one skeleton for all spellings of a name."""

from __future__ import annotations

import re
import unicodedata

# Russian letters and those of neighbours.
_LATIN = dict(
    zip(
        "абвгдеёжзийклмнопрстуфхцчшщъыьэюя",
        ("a", "b", "v", "g", "d", "e", "e", "zh", "z", "i", "y", "k", "l", "m", "n", "o", "p", "r",
         "s", "t", "u", "f", "kh", "ts", "ch", "sh", "shch", "", "y", "", "e", "yu", "ya"),
        strict=True,
    )
) | dict(zip("іїєґўәғқңөұүһҳҷҗӯ", "iieguagknouuhhjju", strict=True))  # fmt: skip

# Letters with accents that are sounds of their own: ISO 9, Czech, Kazakh and Turkish spellings.
_ACCENTED = dict(
    zip("šŝşčçžüūöäâûèğñ", ("sh", "shch", "sh", "ch", "ch", "zh", "u", "u", "o", "a",
                           "ya", "yu", "e", "g", "n"), strict=True)
)  # fmt: skip
_APOSTROPHES = re.compile(r"(?<=[^\W\d_])['’‘ʼʹ`´ʺ\"]+(?=[^\W\d_])|[ʹʺʼ]")

# From spellings of passports (ICAO, 1997), GOST, BGN, ISO 9 and people's own to one another.
_RULES = tuple(
    (re.compile(pattern), to)
    for pattern, to in (
        (r"tsch|tch", "ch"),
        (r"sch?ch|shh|shch|sch", "sh"),
        (r"zh", "z"),
        (r"kh|gh", lambda match: match[0][0].replace("k", "h")),
        (r"ts|tz|tc|cz", "c"),
        (r"ck|c(?=t)", "k"),
        (r"x", "ks"),
        (r"q", "k"),
        (r"w", "v"),
        (r"ph", "f"),
        (r"ou", "u"),
        (r"ff\b", "v"),
        (r"ng", "n"),
        (r"(?<=[dt])er\b", "r"),
        (r"ie(?=i|y)", "y"),  # the hard sign of a passport
        (r"[ijy]+o|(?<=sh|ch)o|(?<=z)o", "e"),
        (r"[ijy]+(?=[aeu])", ""),
        (r"(?<=[aeou])[ijy]+", ""),
        (r"[ijy]+", "i"),
        (r"(.)\1+", r"\1"),
    )
)


def latin(text: str) -> str:
    """Small letters, Cyrillic ones spelt in Latin, without accents."""
    plain = unicodedata.normalize("NFC", text.casefold())
    return _bare("".join(_LATIN.get(char, char) for char in plain))


def _bare(text: str) -> str:
    return "".join(
        char for char in unicodedata.normalize("NFKD", text) if not unicodedata.combining(char)
    )


def words(text: str) -> set[str]:
    """Words in Latin letters, so that Иванов is found in ivanov_kr.xlsx."""
    return set(filter(None, re.split(r"[\W\d_]+", latin(text))))


def skeletons(text: str) -> set[str]:
    """Skeletons of the words of a text: the same for Яковлев, Yakovlev, Iakovlev and Jakovlev.

    A letter of two readings (x, a j that begins a word) gives both.
    """
    plain = unicodedata.normalize("NFC", _APOSTROPHES.sub("", text.casefold()))
    sounds = "".join(_ACCENTED.get(char, _LATIN.get(char, char)) for char in plain)
    parts = set(filter(None, re.split(r"[\W\d_]+", _bare(sounds))))
    parts |= {part.replace("x", "h") for part in parts}
    parts |= {f"zh{part[1:]}" for part in parts if part.startswith("j")}
    return {_skeleton(part) for part in parts} - {""}


def skeleton(text: str) -> str:
    """Skeleton of a name in Cyrillic letters, its words in the order of the alphabet."""
    return " ".join(sorted(skeletons(text)))


def _skeleton(word: str) -> str:
    for pattern, to in _RULES:
        word = pattern.sub(to, word)
    return word


# The Latin letters that look Cyrillic, by their Unicode names; ё for е, й for и.
_TWINS = {
    ord(unicodedata.lookup(f"LATIN SMALL LETTER {here}")): f"CYRILLIC SMALL LETTER {there}"
    for here, there in (("A", "A"), ("C", "ES"), ("E", "IE"), ("O", "O"), ("P", "ER"), ("X", "HA"),
                        ("Y", "U"), ("K", "KA"), ("M", "EM"), ("T", "TE"), ("B", "VE"), ("H", "EN"))
}  # fmt: skip
_TWINS = {code: unicodedata.lookup(name) for code, name in _TWINS.items()} | {
    ord("ё"): "е", ord("й"): "и",
}  # fmt: skip


def twin(text: str) -> str:
    """A name without what the eye overlooks: ё for е, й for и, Latin letters that look Cyrillic."""
    return " ".join(text.casefold().translate(_TWINS).split())


def foreign_letters(text: str) -> str:
    """Return the Latin letters of words that are Cyrillic otherwise, and the other way round."""
    letters = ""
    for word in re.findall(r"[^\W\d_]+", text):
        latin_ones = [char for char in word if "LATIN" in unicodedata.name(char, "")]
        russian = [char for char in word if "CYRILLIC" in unicodedata.name(char, "")]
        if latin_ones and russian:
            letters += "".join(russian if len(russian) < len(latin_ones) else latin_ones)
    return letters
