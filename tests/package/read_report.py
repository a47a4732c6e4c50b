"""Reads a page of `graspctl plan --report` as a browser without a network would.

    read_report.py REPORT.html

Fails when the page would load something, or when what it draws in 3D is missing or does not fit together.
"""

import base64
import json
import re
import struct
import sys
from html.parser import HTMLParser

LOADING_ATTRIBUTES = {"src", "srcset", "href", "data", "action", "poster", "background"}
# In style sheets and scripts, which name the namespaces of XHTML and SVG; nobody loads those.
LOADING_TEXT = re.compile(
    r"@import|\burl\(\s*[\"']?(?!data:|#)|\b(?:fetch|importScripts|import)\s*\(\s*[\"'`]|"
    r"https?://(?!www\.w3\.org/(?:1999/xhtml|2000/svg)\")")


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.element, self.policy, self.loads, self.data = None, "", [], ""

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.element = (tag, given.get("id"))
        if given.get("http-equiv", "").lower() == "content-security-policy":
            self.policy = given["content"]
        self.loads += [f"<{tag} {name}={value[:60]!r}>" for name, value in attrs
                       if name in LOADING_ATTRIBUTES and not value.startswith(("data:", "#"))]

    def handle_endtag(self, tag):
        self.element = None

    def handle_data(self, text):
        if self.element == ("script", "graspd-data"):
            self.data += text
        elif self.element and self.element[0] in ("script", "style"):
            self.loads += [text[found.start():found.start() + 60]
                           for found in LOADING_TEXT.finditer(text)]


def numbers(text, kind):
    """The values of a base64 of little-endian floats (f) or indices (I)."""
    raw = base64.b64decode(text, validate=True)
    return struct.unpack(f"<{len(raw) // 4}{kind}", raw)


def main(path):
    page = Page()
    with open(path, encoding="utf-8") as file:
        page.feed(file.read())
    assert not page.loads, f"the page loads {page.loads}"
    assert "default-src 'none'" in page.policy, f"policy {page.policy!r}"
    report = json.loads(page.data)
    vertices = numbers(report["object"]["vertices"], "f")
    faces = numbers(report["object"]["faces"], "I")
    concavity = numbers(report["object"]["concavity"], "f")
    assert len(vertices) % 3 == 0 and len(faces) % 3 == 0, (len(vertices), len(faces))
    assert faces and max(faces) < len(vertices) // 3, "a face of no vertex"
    assert len(concavity) == len(vertices) // 3, (len(concavity), len(vertices))
    assert max(map(abs, vertices)) > 0, "an object of no size"
    assert report["candidates"]["count"] > 0, "no candidates"
    print(f"report: {len(vertices) // 3} vertices, {len(faces) // 3} faces, "
          f"{report['candidates']['count']} candidates, loads nothing")


if __name__ == "__main__":
    main(sys.argv[1])
