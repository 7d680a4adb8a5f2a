"""The elastic links of a machine that are no bars of a parallelogram are stiffer or softer than its file says."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Parameter, Values
from vjm.effects.parts import OfParts
from vjm.parts import Elastic, Part


class LinkCompliance(OfParts):
    """The 6x6 stiffness of every elastic link is scaled."""

    name = "link_compliance"
    title = "stiffness of all elastic links scaled, beside the bars of parallelograms"
    equation = "K -> scale K of every link"
    signature = "slopes change in the directions in which the links give, turning with the legs; no curvature"
    limits = "one factor for all links and all entries"
    source = "linear elasticity: stiffness is proportional to the modulus"
    parts = "links"
    parameters = (Parameter("scale", "1", 1.0, 0.1, 0.2, 5.0, "stiffness of all links over the nominal one"),)

    def changed_part(self, part: Part, values: Values) -> Part:
        return replace(part, link=part.link.stiffened(values["scale"])) if isinstance(part, Elastic) else part
