"""The parallelogram as virtual springs, loaded past what a lumped 6x6 can tell: bars in segments, 4 kN along x."""

import numpy as np

from vjm import paper
from vjm.equilibrium import equilibrium
from vjm.mechanisms.parallelogram import Parallelogram
from vjm.stiffness import loaded_stiffness

linkage = Parallelogram(310.0, 80.0, paper.BAR_STIFFNESS, q=np.radians(30)).refined()
target = linkage.unloaded_pose * [0, 1, 1, 1, 1, 1] + [-4000, 0, 0, 0, 0, 0]  # Fx in N, the rest held
state = equilibrium(linkage, target, held=("y", "z", "rx", "ry", "rz"))
print(state.reason, state.pose, state.wrench, state.unstable, loaded_stiffness(state)[0, 0])
