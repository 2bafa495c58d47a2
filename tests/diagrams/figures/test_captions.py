"""No picture without words, no words without a picture."""

import re

from footfall.diagrams.figures.captions import CAPTIONS, OVER_TIME
from footfall.diagrams.figures.film_strip import STRIP_FILE
from footfall.diagrams.figures.run_figures import CROSSING_FIGURES, RUN_FIGURES
from footfall.diagrams.judge.meanings import summary_meanings


def test_every_picture_has_a_caption() -> None:
    """The film strip too."""
    strip = STRIP_FILE.rpartition("/")[2].removesuffix(".png")
    assert set(CAPTIONS) == {strip, *RUN_FIGURES, *CROSSING_FIGURES}
    assert set(OVER_TIME) <= set(RUN_FIGURES)


def test_captions_name_figures_that_exist() -> None:
    """In backticks."""
    names = {name for meaning in summary_meanings() for name in meaning.names}
    for caption in CAPTIONS.values():
        assert set(re.findall(r"`(.*?)`", caption.text)) <= names
        assert caption.text.endswith(".")
