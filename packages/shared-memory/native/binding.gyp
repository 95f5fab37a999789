{
  "targets": [
    {
      "target_name": "farpoint_shared_memory",
      "sources": ["addon.c", "mapping.c", "guard.c", "decode.c", "watch.c", "control.c"],
      "defines": ["NAPI_VERSION=8", "_GNU_SOURCE"],
      "cflags": ["-std=c11", "-Wall", "-Wextra", "-Wno-unused-parameter", "-O3", "-fvisibility=hidden"],
      "cflags_c": ["-std=c11"],
      # Node unloads an addon with the last worker that uses it, which may be before that thread is done with it.
      "ldflags": ["-Wl,-z,nodelete"]
    }
  ]
}
