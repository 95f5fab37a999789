/** Chooses among what the headset's display offers. Pure. */

/**
 * @param offered rates of the display, Hz; undefined if the headset does not let the page choose
 * @param most the highest rate that is wanted, Hz
 * @returns the highest rate that is not above it, else the lowest; `null` if there is none to choose
 */
export function chooseFrameRate(offered: ArrayLike<number> | undefined, most: number): number | null {
  let best: number | null = null;
  for (let i = 0; i < (offered?.length ?? 0); i++) {
    const rate = offered?.[i] as number;
    if (!(rate > 0)) continue;
    const fits = rate <= most;
    if (best === null || (fits ? best > most || rate > best : rate < best)) best = rate;
  }
  return best;
}

/**
 * @param wanted share of the resolution that the headset recommends
 * @param native the same of the display's own pixels; more would be computed for nothing
 */
export function chooseResolution(wanted: number, native: number): number {
  return native > 0 ? Math.min(wanted, Math.max(native, 1)) : wanted;
}
