/** @returns the name of a recording that begins now, which sorts by time: `robot-1-20261127T093501Z.mcap` */
export function recordingName(robotId: string, now: Date): string {
  const stamp = now.toISOString().replaceAll(/[-:]|\.\d+/g, '');
  return `${robotId.replaceAll(/[^\w.-]/g, '_')}-${stamp}.mcap`;
}
