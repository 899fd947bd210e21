"""The format's objects in plain Python, without the library: made, read from canonical XML and written to it.

    from sbfmt.document import Record, save_whole, to_xml
    asset = Record("asset")
    asset.add("bones", id="hip", head=(0, 1, 0), length=0.2)
    save_whole("hip.sbf", to_xml(asset))

What fields there are, and what they mean, says spec/reference.md; `elements` has them as a table. Nothing is checked but
types: that is what `sbfmt validate` and `Asset.validate` are for.
"""

from .reading import from_xml
from .record import Record
from .writing import save_whole, to_parts, to_xml

__all__ = ["Record", "from_xml", "save_whole", "to_parts", "to_xml"]
