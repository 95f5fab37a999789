{
  "variables": {
    "cyclonedds%": "<!(node -p \"process.env.CYCLONEDDS_HOME || ''\")"
  },
  "targets": [
    {
      "target_name": "farpoint_dds",
      "sources": [
        "addon.c", "values.c", "handle.c", "js_graph.c", "js_reader.c", "js_writer.c",
        "raw_type.c", "domain.c", "log.c", "graph.c", "matched.c", "reader.c", "writer.c"
      ],
      "include_dirs": ["<!(node -p \"require('node:path').dirname(require.resolve('@farpoint/native-addon/include/farpoint_addon.h'))\")"],
      "defines": ["NAPI_VERSION=8", "_GNU_SOURCE", "DDS_NDEBUG"],
      "cflags": ["-std=gnu11", "-Wall", "-Wextra", "-Wno-unused-parameter", "-O2", "-fvisibility=hidden"],
      "cflags_c": ["-std=gnu11"],
      "libraries": ["-lddsc"],
      # CycloneDDS runs code when a thread that used it ends, but Node unloads an addon together with the last worker,
      # before that.
      "ldflags": ["-Wl,-z,nodelete"],
      "conditions": [
        ["cyclonedds != ''", {
          "include_dirs": ["<(cyclonedds)/include"],
          "ldflags": ["-L<(cyclonedds)/lib", "-Wl,-rpath,<(cyclonedds)/lib"]
        }]
      ]
    }
  ]
}
