/** Joins the robot's log of sent packets with the page's record of received ones. */
import { readFileSync } from 'node:fs';

/** Send times by packet, from the `packets.csv` that it writes with `--measure`. */
export type SentTimes = ReadonlyMap<string, number>;

export function readPacketLog(path: string): SentTimes {
  const [header, ...lines] = readFileSync(path, 'utf8').trimEnd().split('\n');
  if (header !== 'frameNumber,sequenceOffset,sentMs') throw new Error(`${path}: not a packet log`);
  const times = new Map<string, number>();
  for (const line of lines) {
    const [frame, offset, sentMs] = line.split(',').map(Number) as [number, number, number];
    times.set(packetKey(frame, offset), sentMs);
  }
  return times;
}

/**
 * @param received frame number, sequence offset and arrival (ms), packet after packet
 * @returns time from sending to arrival of each packet in both records, ms
 */
export function deliveryTimes(sent: SentTimes, received: readonly number[]): number[] {
  const times: number[] = [];
  for (let i = 0; i + 2 < received.length; i += 3) {
    const sentMs = sent.get(packetKey(received[i] as number, received[i + 1] as number));
    if (sentMs !== undefined) times.push((received[i + 2] as number) - sentMs);
  }
  return times;
}

function packetKey(frame: number, offset: number): string {
  return `${frame}:${offset}`;
}
