"""The format's objects in plain Python, without the library: make them, read and write them as canonical XML.

    from sbfmt.document import Record, save_whole, to_xml
    asset = Record("asset")
    asset.add("bones", id="hip", head=(0, 1, 0), length=0.2)
    save_whole("hip.sbf", to_xml(asset))

spec/reference.md describes the fields; `elements` has them as a table. Only types are checked here; `sbfmt validate` and
`Asset.validate` check the rest.
"""

from .reading import from_xml
from .record import Record
from .writing import save_whole, to_parts, to_xml

__all__ = ["Record", "from_xml", "save_whole", "to_parts", "to_xml"]
