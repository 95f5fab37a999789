/** A time in NTP's timestamp format (RFC 5905 §6), as RTCP and the capture time extension carry it. */
export interface NtpTime {
  /** Seconds since 1900, 32 bits; wraps in 2036. */
  seconds: number;
  /** Of a second, in units of 2⁻³² s, 32 bits. */
  fraction: number;
}

/** Parts of a second in an NTP fraction. */
export const NTP_UNIT = 0x1_0000_0000;
/** From 1900 to the Unix epoch, s. */
const UNIX_EPOCH = 2_208_988_800;

/**
 * The NTP time of an instant. Exact to 2⁻³² s; what a number of milliseconds can express is coarser, 0.25 µs today.
 *
 * @param unixMs ms since the Unix epoch, with fraction; not negative
 */
export function ntpOfUnixMs(unixMs: number): NtpTime {
  const wholeMs = Math.floor(unixMs);
  const seconds = Math.floor(wholeMs / 1000);
  const ms = wholeMs - seconds * 1000 + (unixMs - wholeMs);
  // Only a rounded product can reach a whole second.
  const fraction = Math.min(NTP_UNIT - 1, Math.floor((ms / 1000) * NTP_UNIT));
  return { seconds: (seconds + UNIX_EPOCH) % NTP_UNIT, fraction };
}

/**
 * The NTP time of an instant, to the nanosecond.
 *
 * @param unixSeconds whole seconds since the Unix epoch; not negative
 * @param nanoseconds 0–999,999,999
 */
export function ntpOfUnixNanoseconds(unixSeconds: number, nanoseconds: number): NtpTime {
  return {
    seconds: (unixSeconds + UNIX_EPOCH) % NTP_UNIT,
    fraction: Math.floor((nanoseconds / 1e9) * NTP_UNIT),
  };
}

/**
 * Milliseconds since the Unix epoch, to 0.25 µs. The time is taken to lie between 1968 and 2104: seconds whose upper bit
 * is not set have wrapped (RFC 4330 §3).
 */
export function unixMsOfNtp({ seconds, fraction }: NtpTime): number {
  const wrapped = seconds < NTP_UNIT / 2 ? NTP_UNIT : 0;
  return (seconds + wrapped - UNIX_EPOCH) * 1000 + (fraction / NTP_UNIT) * 1000;
}

/** Reads 8 bytes, big-endian. */
export function readNtp(view: DataView, at: number): NtpTime {
  return { seconds: view.getUint32(at), fraction: view.getUint32(at + 4) };
}

/** Writes 8 bytes, big-endian. */
export function writeNtp(view: DataView, at: number, time: NtpTime): void {
  view.setUint32(at, time.seconds);
  view.setUint32(at + 4, time.fraction);
}
