"""Inputs of a principled shader's sockets: an image, a factor on it, a cutoff. Import makes these nodes, export reads them."""

from dataclasses import dataclass


@dataclass
class Source:
    """The source of a socket's value. `factor` is a number, or three for a colour; `cutoff` is a threshold, or None."""

    image: object = None
    factor: object = 1.0
    cutoff: object = None


def active(sockets, name):
    """The enabled socket of that name. Mix nodes have one socket for each type of data."""
    return next((one for one in sockets if one.name == name and one.enabled), None)


def constant(socket):
    """The number or colour in a socket."""
    value = socket.default_value
    return tuple(value)[:3] if hasattr(value, "__len__") else value


def pair_of(node):
    """(constant, socket of the rest) of a node that multiplies by a constant, or None."""
    if node.type == "MATH":
        sides = list(node.inputs)[:2]
    elif node.type == "MIX_RGB":
        sides = [node.inputs["Color1"], node.inputs["Color2"]]
    else:
        sides = [active(node.inputs, "A"), active(node.inputs, "B")]
    plain = [one for one in sides if one is not None and not one.links]
    linked = [one for one in sides if one is not None and one.links]
    return (constant(plain[0]), linked[0]) if len(plain) == len(linked) == 1 else None


def multiplies(node):
    return node.type == "MATH" and node.operation == "MULTIPLY" or \
        node.type in ("MIX_RGB", "MIX") and node.blend_type == "MULTIPLY"


def product(one, other):
    """The product of two factors, each a number or three."""
    if isinstance(one, tuple) or isinstance(other, tuple):
        first, second = (value if isinstance(value, tuple) else (value, ) * 3 for value in (one, other))
        return tuple(a * b for a, b in zip(first, second))
    return one * other


def source_of(socket):
    """The image that a socket gets, through a normal map, a separated channel, a constant factor or a threshold."""
    found = Source()
    while socket is not None and socket.links:
        node = socket.links[0].from_node
        if node.type == "TEX_IMAGE":
            found.image = node.image
            return found
        if node.type == "MATH" and node.operation == "GREATER_THAN":
            found.cutoff, socket = node.inputs[1].default_value, node.inputs[0]
            continue
        by_constant = pair_of(node) if multiplies(node) else None
        if by_constant:
            found.factor, socket = product(found.factor, by_constant[0]), by_constant[1]
            continue
        names = [name for name in ("Color", "Image", "Vector") if name in node.inputs]
        socket = node.inputs[names[0]] if names else next(iter(node.inputs), None)
    if socket is not None and not socket.links and found.cutoff is not None and not hasattr(socket.default_value, "__len__"):
        found.factor = product(found.factor, socket.default_value)
    return found


class Nodes:
    """Makes nodes that `source_of` reads, in one material."""

    def __init__(self, material):
        self.tree = material.node_tree
        self.shader = next(node for node in self.tree.nodes if node.type == "BSDF_PRINCIPLED")
        self.images = {}

    def input(self, *names):
        """The shader's socket of the first of these names that it has."""
        return next((self.shader.inputs[name] for name in names if name in self.shader.inputs), None)

    def new(self, kind, **settings):
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def link(self, start, end):
        self.tree.links.new(start, end)

    def image(self, image, colors=True):
        """The node of an image and a kind of data, made once."""
        if (image.name, colors) not in self.images:
            node = self.images[image.name, colors] = self.new("ShaderNodeTexImage", image=image)
            if not colors:
                image.colorspace_settings.name = "Non-Color"
            node.location = (-900, 300 - 300 * len(self.images))
        return self.images[image.name, colors]

    def color_times(self, start, factor):
        """A socket of the colour times a constant one; where that is white, the colour itself."""
        if all(abs(one - 1) < 1e-6 for one in factor):
            return start
        node = self.new("ShaderNodeMix", data_type="RGBA", blend_type="MULTIPLY", location=(-300, 300))
        active(node.inputs, "Factor").default_value = 1.0
        active(node.inputs, "B").default_value = (*factor, 1.0)
        self.link(start, active(node.inputs, "A"))
        return active(node.outputs, "Result")

    def times(self, start, factor):
        if abs(factor - 1) < 1e-6:
            return start
        return self.by(start, factor, "MULTIPLY")

    def by(self, start, number, operation):
        """A number times a constant; `start` is a socket or a number."""
        node = self.new("ShaderNodeMath", operation=operation, location=(-300, 0))
        if isinstance(start, float):
            node.inputs[0].default_value = start
        else:
            self.link(start, node.inputs[0])
        node.inputs[1].default_value = number
        return node.outputs[0]
