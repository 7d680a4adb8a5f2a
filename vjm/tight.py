"""A rig without what slides in its joints: where a linkage whose laws are steep is begun (`vjm.slides`)."""

from __future__ import annotations

from dataclasses import replace

from vjm.effects.base import Rig, for_bars
from vjm.link import Link
from vjm.site_joint import SiteJoint
from vjm.slides import Giving


def tight(rig: Rig) -> Rig:
    """The rig with all axes rigid whose displacement is known from its load."""

    def without(joints: tuple[SiteJoint, ...]) -> tuple[SiteJoint, ...]:
        return tuple(joint for joint in joints if not isinstance(joint.law, Giving))

    def held(link: Link) -> Link:
        return replace(
            link, slides=(), base_joints=without(link.base_joints), tip_joints=without(link.tip_joints)
        )

    still = for_bars(rig, held)
    if not any(isinstance(joint.law, Giving) for joint in rig.base_joints):
        return still
    base = tuple(
        SiteJoint(joint.axis, None, f"tight.{k}", apart=True) if isinstance(joint.law, Giving) else joint
        for k, joint in enumerate(rig.base_joints)
    )
    return replace(still, base_joints=base)
