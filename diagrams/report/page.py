"""What the pages of runs and sweeps share: the template, and files put into them."""

import base64
import gzip
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

from footfall.diagrams.figures.captions import Caption

PAGE_FILE = "report.html"
"""In the folder of the run or the sweep."""
MEDIA = {".png": "image/png", ".svg": "image/svg+xml", ".yaml": "text/plain"}
"""Media types by what a file's name ends with."""


@dataclass(frozen=True)
class Picture:
    """A picture of a page."""

    name: str
    uri: str
    caption: Caption


def data_uri(path: Path) -> str:
    """Writes a file as an address that holds it.

    Raises:
        OSError: it cannot be read.
    """
    content = base64.b64encode(path.read_bytes()).decode("ascii")
    return f"data:{MEDIA[path.suffix]};base64,{content}"


def packed(path: Path) -> str:
    """Compresses a file and writes it in base64, as `page.html.j2` unpacks it.

    Raises:
        OSError: it cannot be read.
    """
    # Without a time stamp: the same run gives the same page.
    return base64.b64encode(gzip.compress(path.read_bytes(), mtime=0)).decode("ascii")


def render_page(template: str, **values: object) -> str:
    """Fills in a template; what is no markup is escaped.

    Args:
        template: its name in `templates`.
        values: by the names that the template has for them.

    Raises:
        UndefinedError: the template names a value that is not given.
    """
    environment = Environment(
        loader=PackageLoader("footfall.diagrams.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(template).render(**values)
