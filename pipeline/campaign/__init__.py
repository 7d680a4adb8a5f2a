"""Measurement campaigns: a folder of campaign.toml and measurements.csv, read with complaints worth reading."""

from pipeline.campaign.model import Campaign, Data, Gauge, Noise, Rig, Test, UniformBar
from pipeline.campaign.reading import read
from pipeline.campaign.writing import write
from pipeline.toml.complaints import BadCampaign

__all__ = ["BadCampaign", "Campaign", "Data", "Gauge", "Noise", "Rig", "Test", "UniformBar", "read", "write"]
