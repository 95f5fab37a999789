/** What packets did to a program's main thread and memory, and whether that is too much. Pure. */

/** Longest pause of the main thread; the driver's commands wait that long. */
const MAX_GAP_MS = 150;
/** Processor time of the main thread for each packet: several times that of an ordinary one, with its deciphering. */
const MAX_PROCESSOR_US = 500;
export const MAX_GROWTH_BYTES = 50 << 20;

/** A program at one moment. */
export interface Reading {
  /** Any clock, ms. */
  atMs: number;
  /** Processor time of its main thread since it began, ms. */
  processorMs: number;
  /** The longest pause of its event loop since the reading before, ms. */
  gapMs: number;
  /** Resident memory. */
  bytes: number;
}

export interface Strain {
  packets: number;
  gapMs: number;
  /** Beyond what the program used before. */
  processorUs: number;
  grownBytes: number;
}

export interface Readings {
  /** Before anything was sent. */
  first: Reading;
  /** Two in a row, between which nothing was sent. */
  idle: readonly [Reading, Reading];
  /** After the packets; the second of the idle ones is before them. */
  last: Reading;
}

export function strainOf({ first, idle: [from, before], last }: Readings, packets: number): Strain {
  const usual = (before.processorMs - from.processorMs) / Math.max(1, before.atMs - from.atMs);
  const used = last.processorMs - before.processorMs - usual * (last.atMs - before.atMs);
  return {
    packets,
    gapMs: last.gapMs,
    processorUs: (Math.max(0, used) * 1000) / packets,
    grownBytes: last.bytes - first.bytes,
  };
}

/** @returns why it is too much, `null` if it is not */
export function excessiveStrain({ gapMs, processorUs, grownBytes }: Strain): string | null {
  if (gapMs > MAX_GAP_MS) return `the robot paused for ${gapMs.toFixed(0)} ms`;
  if (processorUs > MAX_PROCESSOR_US) return `a packet took ${processorUs.toFixed(0)} µs of the robot`;
  if (grownBytes > MAX_GROWTH_BYTES) return `the robot has grown by ${(grownBytes / 2 ** 20).toFixed(0)} MB`;
  return null;
}

export function strainText({ packets, gapMs, processorUs, grownBytes }: Strain): string {
  return `${packets} packets, ${processorUs.toFixed(0)} µs each, pause ${gapMs.toFixed(0)} ms, ${(grownBytes / 2 ** 20).toFixed(0)} MB`;
}
