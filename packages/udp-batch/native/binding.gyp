{
  "targets": [
    {
      "target_name": "farpoint_udp_batch",
      "sources": ["addon.c", "batch.c"],
      "include_dirs": ["<!(node -p \"require('node:path').dirname(require.resolve('@farpoint/native-addon/include/farpoint_addon.h'))\")"],
      "defines": ["NAPI_VERSION=8", "_GNU_SOURCE"],
      "cflags": ["-std=c11", "-Wall", "-Wextra", "-Wno-unused-parameter", "-O2", "-fvisibility=hidden"],
      "cflags_c": ["-std=c11"],
      # Node unloads an addon with the last worker that uses it, possibly before that thread has finished with it.
      "ldflags": ["-Wl,-z,nodelete"]
    }
  ]
}
