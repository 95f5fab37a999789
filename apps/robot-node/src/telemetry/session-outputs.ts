/** Where a session goes besides its operators: into a file, and to live viewers. */
import type { CloudKind } from '@farpoint/recording';
import type { FOXGLOVE_REACHES } from '../options/foxglove.ts';
import type { RecordedVideos } from '../options/recording.ts';

export interface RecordingOptions {
  /** Path of the MCAP file that is written from the start, which must not exist yet; `null` for none. */
  path: string | null;
  /** Where operators' recordings go, and their size in all; `null`: operators begin none. */
  folder: { path: string; mostBytes: number } | null;
  compression: 'none' | 'zstd';
  /** Highest number of clouds per second; 0 records none. */
  clouds: Readonly<Record<CloudKind, number>>;
  videos: RecordedVideos;
  /** A recording ends, complete, before it exceeds this size. */
  mostBytes: number;
}

/** A server that shows live what a recording contains. */
export interface LiveOptions {
  port: number;
  reach: (typeof FOXGLOVE_REACHES)[number];
  /** Origins of web pages that may connect, besides the viewers' own and pages of this machine. */
  allowedOrigins: readonly string[];
  /** Highest number of clouds of each kind per second. */
  cloudsPerSecond: number;
}

/** At least one of them. */
export interface SessionOutputs {
  record: RecordingOptions | null;
  foxglove: LiveOptions | null;
}
