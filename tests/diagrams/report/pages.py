"""What a page holds, read as a browser would."""

from html.parser import HTMLParser
from pathlib import Path


class Page(HTMLParser):
    """A page's text, addresses, and texts of its scripts by id."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.scripts: dict[str, str] = {}
        self._texts: list[str] = []
        self._script: str | None = None
        self.feed(path.read_text(encoding="utf-8"))

    @property
    def text(self) -> str:
        """All that is read, blanks closed up."""
        return " ".join(" ".join(self._texts).split())

    @property
    def outer_addresses(self) -> list[str]:
        """Those that lead out of the page."""
        return [one for one in self.addresses if not one.startswith(("data:", "#"))]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Notes addresses, and where scripts begin."""
        given = dict(attrs)
        self.addresses += [given[n] or "" for n in ("src", "href") if n in given]
        if tag in ("script", "style"):
            self._script = given.get("id") or tag

    def handle_endtag(self, tag: str) -> None:
        """Ends scripts."""
        if tag in ("script", "style"):
            self._script = None

    def handle_data(self, data: str) -> None:
        """Collects texts."""
        if self._script is None:
            self._texts.append(data)
        else:
            self.scripts[self._script] = self.scripts.get(self._script, "") + data
