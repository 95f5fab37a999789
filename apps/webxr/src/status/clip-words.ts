/** What the page says about clips of the last while. */
export const clipWords = {
  off: 'Clips are off: switch “Keep the last 30 seconds” on in the settings.',
  inVr: 'Clips show what a flat screen shows: leave the headset’s view first.',
  nothingYet: 'There is nothing to save yet.',
  unavailable: 'This browser cannot code videos, so it keeps no clips.',
  failed: 'This browser could not save the clip.',
  stopped: (detail: string) => `No clip is kept any more: ${detail}`,
  saved: (seconds: number) =>
    `A clip of the last ${Math.round(seconds)} second${Math.round(seconds) === 1 ? '' : 's'} was saved.`,
  /** In each picture. @param time for people, in their own time zone */
  caption: (time: string, robot: string | null, isLive: boolean) =>
    [time, robot ?? 'no robot', ...(isLive ? [] : ['NOT LIVE'])].join(' · '),
} as const;
