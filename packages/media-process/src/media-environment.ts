/**
 * What a media program needs of our environment. Everything else stays here: it may hold tokens, and a pipeline and its
 * plugins are other people's code.
 */
const NAMES: ReadonlySet<string> = new Set([
  'PATH',
  'HOME',
  'USER',
  'LOGNAME',
  'SHELL',
  'LANG',
  'LANGUAGE',
  'TZ',
  'TMPDIR',
  'TERM',
  'LD_LIBRARY_PATH',
  'LD_PRELOAD',
  'DISPLAY',
  'WAYLAND_DISPLAY',
  'XAUTHORITY',
  'DBUS_SESSION_BUS_ADDRESS',
  'SSL_CERT_FILE',
  'SSL_CERT_DIR',
  'ORC_CODE',
]);
const BEGINNINGS: readonly string[] = [
  'LC_',
  'XDG_',
  'GST_',
  'GIO_',
  'G_',
  'GI_',
  'OPENSSL_',
  'PULSE_',
  'PIPEWIRE_',
  'SPA_',
  'ALSA_',
  'JACK_',
  'LIBVA_',
  'VDPAU_',
  'CUDA_',
  'NVIDIA_',
  'EGL_',
  'MESA_',
  'DRI_',
  'LIBGL_',
  'VK_',
  'LIBCAMERA_',
  'ASAN_',
  'UBSAN_',
];
/** Names that say that the value is a secret, whatever they begin with. */
const SECRET = /token|secret|passw|credential|api_?key|private/i;

export function mediaEnvironment(own: NodeJS.ProcessEnv): NodeJS.ProcessEnv {
  const passed = Object.entries(own).filter(
    ([name]) =>
      !SECRET.test(name) && (NAMES.has(name) || BEGINNINGS.some((beginning) => name.startsWith(beginning))),
  );
  return Object.fromEntries(passed);
}
