"""The only room that knows Numba: kernels, where their machine code is kept, and the threads they run on."""

from eyeline.jit.folder import announce as announce
from eyeline.jit.folder import cache_folder as cache_folder
from eyeline.jit.folder import cache_root as cache_root
from eyeline.jit.kernels import KERNELS as KERNELS
from eyeline.jit.kernels import Helper as Helper
from eyeline.jit.kernels import Kernel as Kernel
from eyeline.jit.kernels import helper as helper
from eyeline.jit.kernels import kernel as kernel
from eyeline.jit.kernels import trailing_zeros as trailing_zeros
from eyeline.jit.sharing import in_parts as in_parts
from eyeline.jit.sharing import share as share
from eyeline.jit.sharing import threads as threads
from eyeline.jit.stack import fetch as fetch
from eyeline.jit.stack import on_stack as on_stack
