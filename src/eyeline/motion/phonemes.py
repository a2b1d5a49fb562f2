"""Phonemes, as ARPAbet writes them, and the mouths that say them."""

from __future__ import annotations

from eyeline.errors import SceneError, suggestion

# By viseme, named after the fifteen that are in common use: the phonemes it stands for
SPOKEN: dict[str, str] = {
    "viseme_sil": "- sil sp pau",
    "viseme_PP": "P B M",
    "viseme_FF": "F V",
    "viseme_TH": "TH DH",
    "viseme_DD": "T D",
    "viseme_kk": "K G NG HH",
    "viseme_CH": "CH JH SH ZH",
    "viseme_SS": "S Z",
    "viseme_nn": "N L",
    "viseme_RR": "R ER",
    "viseme_aa": "AA AE AH AY AW",
    "viseme_E": "EH EY",
    "viseme_I": "IH IY Y",
    "viseme_O": "AO OW OY",
    "viseme_U": "UH UW W",
}

VISEMES = tuple(SPOKEN)

_MOUTHS = {phoneme: name for name, spoken in SPOKEN.items() for phoneme in spoken.split()}


def viseme(phoneme: str) -> str:
    """The viseme of a phoneme; digits that mark its stress do not count."""
    bare = phoneme.rstrip("012")
    if bare not in _MOUTHS:
        raise SceneError(f"there is no phoneme {phoneme!r}{suggestion(bare, _MOUTHS)}")
    return _MOUTHS[bare]
