{
  "targets": [
    {
      "target_name": "farpoint-video",
      "type": "executable",
      "sources": [
        "main.c", "wire.c", "log.c", "pipeline.c", "rate.c", "size.c", "barcode.c", "encoded.c", "frames.c",
        "coded.c", "decoder.c", "decode.c", "encoders.c", "faults.c"
      ],
      "defines": ["_GNU_SOURCE"],
      "cflags": [
        "-std=gnu11", "-Wall", "-Wextra", "-Wno-unused-parameter", "-O2",
        "<!@(pkg-config --cflags gstreamer-1.0 gstreamer-app-1.0 gstreamer-video-1.0)"
      ],
      "cflags_c": ["-std=gnu11"],
      "libraries": ["<!@(pkg-config --libs gstreamer-1.0 gstreamer-app-1.0 gstreamer-video-1.0)"]
    }
  ]
}
