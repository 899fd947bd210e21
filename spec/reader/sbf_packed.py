"""The packed form: packed.md, with its section numbers."""

import struct
import zlib

from sbf_elements import ELEMENTS, KNOWN_VERSION, ROOT, Fault, Object
from sbf_words import WORDS
from sbf_numbers import floats_of_bytes, uints_of_bytes

MAGIC = b"\x89SBF\r\n\x1a\n"
ABSENT = 0xFFFFFFFF
NO_LEVEL = 0xFFFFFFFF
VALUE, TEXT, LIST, CHUNK, RECORD, RECORDS, PARTS, PLANES, DELTA = range(9)
FORMS = {"string": (TEXT,), "text": (TEXT,), "id": (TEXT,), "one": (RECORD,), "optional": (RECORD,)}
PART_KINDS = {element.part for element in ELEMENTS.values() if element.part}
MOST_INFLATED = 1 << 32


class Entry:
    """A line of the table of contents, section 3."""

    def __init__(self, data):
        (kind, self.owner, self.level, self.field, self.list, self.filter, self.codec, self.flags, self.stride,
         self.offset, self.stored, self.raw, self.count, self.crc, self.reserved) = \
            struct.unpack("<4sIIHHBBHIQQQQII", data)
        self.kind = kind.decode("latin-1")
        self.used = False

    def is_known(self):
        return self.kind in PART_KINDS

    def place(self):
        return self.kind, self.owner, self.level, self.field, self.list


class Part:
    """Where a part stands: what its chunks say of themselves."""

    def __init__(self, kind, owner, level, field):
        self.kind, self.owner, self.level, self.field = kind, owner, level, field


class PackedReader:
    """Reads one file; parts are taken breadth first, as their numbers run."""

    def __init__(self, data):
        self.data, self.newer, self.entries = data, False, []
        self.pending = []  # records of parts to be read: (object, part)

    def read(self):
        self.read_header()
        self.check_table()
        root = Object(ROOT)
        self.entries[0].used = True
        self.pending.append((root, Part("ROOT", 0, NO_LEVEL, 0), 0))
        while self.pending:
            target, part, number = self.pending.pop(0)
            self.read_record(target, self.chunk_bytes(number), part, label=None if number == 0 else False)
        for number, entry in enumerate(self.entries):
            if entry.is_known() and not entry.used:
                raise Fault(f"nothing names chunk {number}")
        self.check_unread()
        resolve(root)
        return root

    def read_header(self):
        data = self.data
        if len(data) < 64:
            raise Fault("the file is shorter than a header")
        (magic, major, minor, least_major, least_minor, size, table, table_size, count, table_crc, reserved, crc) = \
            struct.unpack("<8sHHHHQQQII12sI", data[:64])
        if magic != MAGIC:
            raise Fault("the magic is another")
        if zlib.crc32(data[:60]) != crc:
            raise Fault("the header does not match its checksum")
        if (least_major, least_minor) > KNOWN_VERSION:
            raise Fault(f"a reader of version {least_major}.{least_minor} is asked for")
        if major != 1:
            raise Fault(f"version {major}.{minor} is of another major version than 1")
        self.minor = minor
        self.newer = (major, minor) > KNOWN_VERSION
        if any(reserved) and not self.newer:
            raise Fault("reserved bytes of the header are set")
        if size != len(data):
            raise Fault(f"the header says {size} bytes, the file has {len(data)}")
        if table % 64 or table < 64 or count < 1 or table_size != 64 * count or table + table_size > size:
            raise Fault("the table does not lie in the file")
        lines = data[table:table + table_size]
        if zlib.crc32(lines) != table_crc:
            raise Fault("the table does not match its checksum")
        self.table = (table, table_size)
        self.entries = [Entry(lines[at:at + 64]) for at in range(0, table_size, 64)]

    def check_table(self):
        end, total = 64, 0
        table_begin, table_end = self.table[0], sum(self.table)
        for number, entry in enumerate(self.entries):
            where = f"chunk {number}"
            if entry.offset % 64 or entry.offset < end or entry.offset + entry.stored > len(self.data):
                raise Fault(f"{where} does not lie inside the file, in order, at a multiple of 64")
            if entry.stored and entry.offset < table_end and entry.offset + entry.stored > table_begin:
                raise Fault(f"{where} lies over the table")
            end = entry.offset + entry.stored
            if (entry.flags & ~3 or entry.reserved) and not self.newer:
                raise Fault(f"{where} has reserved bits set")
            if not entry.is_known():
                if entry.flags & 1:
                    raise Fault(f"{where} is critical and of the unknown kind {entry.kind!r}")
                continue
            if entry.codec > 1 or entry.filter > 3 or (entry.codec == 0 and entry.filter):
                raise Fault(f"{where} has a filter or codec that is not known")
            if entry.raw != entry.count * entry.stride or (entry.codec == 0 and entry.raw != entry.stored):
                raise Fault(f"{where}: its sizes contradict each other")
            if entry.filter and (entry.stride % 4 or not 4 <= entry.stride <= 16):
                raise Fault(f"{where}: no filter goes with its stride")
            if entry.codec == 1 and entry.raw > 1032 * entry.stored + 64:
                raise Fault(f"{where} claims more than zlib can do")
            total += entry.raw
        if total > MOST_INFLATED:
            raise Fault("more than 4 GiB when inflated")
        first = self.entries[0]
        if first.place() != ("ROOT", 0, NO_LEVEL, 0, 0):
            raise Fault("chunk 0 is not the record of the whole asset")

    def check_unread(self):
        """The checksums of chunks that nothing has read, and the zeros between all of them."""
        end, pieces = 64, [(entry.offset, entry.stored) for entry in self.entries]
        for number, entry in enumerate(self.entries):
            if not entry.used and zlib.crc32(self.data[entry.offset:entry.offset + entry.stored]) != entry.crc:
                raise Fault(f"chunk {number} does not match its checksum")
        for begin, size in sorted(pieces + [self.table, (len(self.data), 0)]):
            if any(self.data[end:begin]) and not self.newer:
                raise Fault("a byte between two chunks is not zero")
            end = max(end, begin + size)

    def chunk_bytes(self, number):
        entry = self.entries[number]
        stored = self.data[entry.offset:entry.offset + entry.stored]
        if zlib.crc32(stored) != entry.crc:
            raise Fault(f"chunk {number} does not match its checksum")
        if entry.codec == 0:
            return stored
        stream = zlib.decompressobj()
        try:
            raw = stream.decompress(stored, entry.raw + 1)
        except zlib.error as error:
            raise Fault(f"chunk {number}: {error}") from error
        if len(raw) != entry.raw or not stream.eof or stream.unused_data:
            raise Fault(f"chunk {number} inflates to another size")
        return unfilter(raw, entry.filter, entry.stride // 4)

    def named_chunk(self, number, part, field, in_list, stride):
        """The entry that a record names, which must say the same of itself."""
        if not 0 < number < len(self.entries):
            raise Fault(f"there is no chunk {number}")
        entry = self.entries[number]
        if entry.place() != (part.kind, part.owner, part.level, field, in_list) or entry.stride != stride:
            raise Fault(f"chunk {number} is of another place than it is named in")
        if entry.used:
            raise Fault(f"chunk {number} is named twice")
        entry.used = True
        return entry

    def read_record(self, target, data, part, label):
        """Section 4. `part.field` is the field of the part that the object lies in, 0 for the part itself; `label` is
        None for a whole record, True for a label, False for a record whose label stands elsewhere."""
        at, before, given = 0, 0, set()
        while at < len(data):
            if at + 8 > len(data):
                raise Fault(f"a record of {target.element.name} is cut short")
            number, form, size = struct.unpack_from("<HHI", data, at)
            payload = data[at + 8:at + 8 + size]
            end = at + 8 + (size + 3) // 4 * 4
            if end > len(data) or any(data[at + 8 + size:end]):
                raise Fault(f"field {number} of {target.element.name} does not end where it should")
            if number <= before:
                raise Fault(f"fields of {target.element.name} are out of order")
            at, before = end, number
            field = target.element.by_number.get(number)
            if field is None:
                if not self.newer:
                    raise Fault(f"{target.element.name} has no field {number}")
                continue
            if field.since > self.minor:
                raise Fault(f"{field.name} of {target.element.name} is of version 1.{field.since}")
            in_label = field.kind == "id" or field.name == "name"
            if (label is True and not in_label) or (label is False and in_label):
                raise Fault(f"{field.name} of {target.element.name} stands in the wrong record")
            self.read_field(target, field, form, payload, part)
            given.add(field.name)
        for field in target.element.fields:
            in_label = field.kind == "id" or field.name == "name"
            if field.required and field.name not in given and (label is None or label == in_label):
                raise Fault(f"{field.name} of {target.element.name} is required")
            if field.required and target[field.name] == "":
                if label is None or label == in_label:
                    raise Fault(f"{field.name} of {target.element.name} is empty")

    def read_field(self, target, field, form, payload, part):
        where = f"{field.name} of {target.element.name}"
        if field.is_list:
            target[field.name] = self.read_list(field, form, payload, part, where)
            return
        if field.kind == "many":
            allowed = (PARTS,) if ELEMENTS[field.argument].part else (RECORDS,)
        else:
            allowed = FORMS.get(field.kind, (VALUE,))
        if form not in allowed:
            raise Fault(f"{where} is in form {form}")
        if form == VALUE:
            target[field.name] = read_value(field, payload, where)
        elif form == TEXT:
            try:
                target[field.name] = payload.decode("utf-8")
            except UnicodeDecodeError as error:
                raise Fault(f"{where} is not UTF-8") from error
        elif form == RECORD:
            child = target[field.name] if field.kind == "one" else target.child(field)
            target[field.name] = child
            self.read_record(child, payload, self.inside(part, field), label=None)
        else:
            self.read_many(target, field, form, payload, part)

    @staticmethod
    def inside(part, field):
        """Lists of children lie under the number of the part's own field that leads to them."""
        return Part(part.kind, part.owner, part.level, part.field or field.number)

    def read_list(self, field, form, payload, part, where):
        item = (1 if field.kind == "bytes" else 4) * field.width
        if form == CHUNK:
            if len(payload) != 4:
                raise Fault(f"{where}: the number of a chunk is of four bytes")
            number = struct.unpack("<I", payload)[0]
            self.named_chunk(number, part, part.field or field.number, field.number, item)
            payload = self.chunk_bytes(number)
        elif form in (PLANES, DELTA) and field.kind != "bytes":
            if len(payload) % item:
                raise Fault(f"{where} ends in the middle of an item")
            payload = unfilter(payload, 1 if form == PLANES else 2, field.width)
        elif form != LIST:
            raise Fault(f"{where} is in form {form}")
        if len(payload) % item:
            raise Fault(f"{where} ends in the middle of an item")
        if field.kind == "bytes":
            return payload
        return floats_of_bytes(payload) if field.scalar == "float" else uints_of_bytes(payload)

    def read_many(self, target, field, form, payload, part):
        if len(payload) < 4:
            raise Fault(f"{field.name} has no count")
        count, at = struct.unpack_from("<I", payload)[0], 4
        head = 8 if form == PARTS else 4
        for place in range(count):
            if at + head > len(payload):
                raise Fault(f"{field.name} ends before its count")
            size = struct.unpack_from("<I", payload, at + head - 4)[0]
            fields = payload[at + head:at + head + size]
            if len(fields) != size:
                raise Fault(f"{field.name} ends in the middle of a child")
            child = target.child(field)
            target[field.name].append(child)
            if form == PARTS:
                number = struct.unpack_from("<I", payload, at)[0]
                inner = self.part_of(child, part, place)
                self.read_record(child, fields, inner, label=True)
                self.named_chunk(number, inner, 0, 0, 1)
                self.pending.append((child, inner, number))
            else:
                self.read_record(child, fields, self.inside(part, field), label=None)
            at += head + size
        if at != len(payload):
            raise Fault(f"{field.name} has bytes left over")

    @staticmethod
    def part_of(child, part, place):
        if part.kind == "ROOT":
            return Part(child.element.part, place, NO_LEVEL, 0)
        return Part(child.element.part, part.owner, place, 0)


def read_value(field, payload, where):
    if len(payload) != 4 * field.width:
        raise Fault(f"{where} has {len(payload)} bytes")
    if field.scalar == "float":
        numbers = floats_of_bytes(payload)
        return numbers if field.width > 1 else numbers[0]
    value = struct.unpack("<I", payload)[0]
    if field.kind == "bool":
        if value > 1:
            raise Fault(f"{where} is neither 0 nor 1")
        return value == 1
    if field.kind == "enum":
        if value >= len(WORDS[field.argument]):
            raise Fault(f"{where}: there is no word {value}")
        return WORDS[field.argument][value]
    if field.kind == "ref":
        return None if value == ABSENT else value
    return value if field.kind == "uint" else struct.unpack("<i", payload)[0]


def unfilter(data, kind, width):
    """Section 6."""
    if kind == 0:
        return data
    count, values = len(data) // 4, []
    if kind == 3:
        return unfilter_recent(data, count)
    for begin in range(0, count, 65520):
        n = min(65520, count - begin)
        block = data[4 * begin:4 * (begin + n)]
        woven = bytearray(4 * n)
        for plane in range(4):
            woven[plane::4] = block[plane * n:(plane + 1) * n]
        values += struct.unpack(f"<{n}I", woven)
    if kind == 2:
        for i, x in enumerate(values):
            difference = x >> 1 if not x & 1 else -((x + 1) >> 1)
            values[i] = ((values[i - width] if i >= width else 0) + difference) & 0xFFFFFFFF
    return struct.pack(f"<{len(values)}I", *values)


def unfilter_recent(data, count):
    """Section 6, filter 3."""
    values = []
    for begin in range(0, count, 65520):
        n = min(65520, count - begin)
        places, rest = data[4 * begin:4 * begin + n], data[4 * begin + n:4 * (begin + n)]
        new_count, new = places.count(0), 0
        if max(places) > 32 or 4 * new_count > 3 * n:
            raise Fault("a filtered block says what cannot be")
        row, last = [0] * 32, values[-1] if values else 0
        for place in places:
            if place:
                value = row.pop(place - 1)
            else:
                x = sum(rest[plane * new_count + new] << 8 * plane for plane in range(4))
                last = (last + (x >> 1 if not x & 1 else -((x + 1) >> 1))) & 0xFFFFFFFF
                value = last
                new += 1
                row.pop()
            row.insert(0, value)
            values.append(value)
    return struct.pack(f"<{count}I", *values)


def resolve(root):
    """Turns places in collections into ids."""
    ids = {f.name: [child["id"] for child in root[f.name]] for f in ROOT.fields
           if f.kind == "many" and "id" in ELEMENTS[f.argument].by_name}

    def walk(target):
        for field in target.element.fields:
            value = target[field.name]
            if field.kind == "ref" and value is not None:
                if not 0 <= value < len(ids[field.argument]):
                    raise Fault(f"{field.name} of {target.element.name}: there is no item {value} of {field.argument}")
                target[field.name] = ids[field.argument][value]
            elif field.is_child and value:
                for child in value if isinstance(value, list) else [value]:
                    walk(child)

    walk(root)


def read_packed(data):
    return PackedReader(data).read()
