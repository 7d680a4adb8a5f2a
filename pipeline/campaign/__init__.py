"""Measurement campaigns: a folder of campaign.toml and measurements.csv, read with complaints worth reading."""

from pipeline.campaign.model import Campaign, Data, Gauge, Noise, Rig, Test
from pipeline.campaign.reading import read
from pipeline.campaign.rigs.bar import BarRig
from pipeline.campaign.rigs.bars import RigOfBars, UniformBar
from pipeline.campaign.rigs.manipulator import ManipulatorRig
from pipeline.campaign.rigs.parallelogram import ParallelogramRig
from pipeline.campaign.writing import write
from pipeline.toml.complaints import BadCampaign

__all__ = [
    "BadCampaign",
    "BarRig",
    "Campaign",
    "Data",
    "Gauge",
    "ManipulatorRig",
    "Noise",
    "ParallelogramRig",
    "Rig",
    "RigOfBars",
    "Test",
    "UniformBar",
    "read",
    "write",
]
