{
  "targets": [
    {
      "target_name": "farpoint_systemd",
      "sources": ["addon.c"],
      "defines": ["NAPI_VERSION=8", "_GNU_SOURCE"],
      "cflags": ["-std=c11", "-Wall", "-Wextra", "-Wno-unused-parameter", "-O2", "-fvisibility=hidden"],
      "cflags_c": ["-std=c11"],
    }
  ]
}
