// clang's mode for CUDA includes this header of another library. Nothing here needs it.
