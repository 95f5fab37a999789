/**
 * `window.farpointStage`: what a test, or a person who looks at a state of the page, does with the scripted robot. Only in
 * the testing build, at `?stage=STATE`.
 */
import type { PictureWorkerWatched } from '@farpoint/operator/testing/picture-worker-watched';
import type { ScriptedLink, SentMessage, ToldMessage } from '@farpoint/operator/testing/scripted-link';
import {
  MAX_PICTURE_CHUNK_BYTES,
  type PictureFormat,
  pictureChunks,
  stampUsOf,
  writePictureChunk,
} from '@farpoint/protocol';
import type { App } from '../page/app.ts';
import { bytesOf, type CloudFile, placed } from './cloud-file.ts';
import type { ScriptedRobot } from './scripted-robot.ts';
import { type PictureOptions, type Rgb, ScriptedVideos } from './scripted-videos.ts';

export type { PictureOptions } from './scripted-videos.ts';

declare global {
  interface Window {
    farpointStage: StageControl;
    /** Set by tests before the page loads; called once the page has a scripted robot. */
    farpointStageOpened?: () => void;
  }
}

export interface CloudOptions {
  /** Packets that are lost, by their place in the frame. */
  lose?: readonly number[];
  /** Which of the file's frames. Default: the next. */
  frame?: number;
  sensor?: number;
  /** How long before now it was captured, ms. */
  ageMs?: number;
  /** The camera's height over base_link, metres. */
  heightM?: number;
  /** Whether it answers a latency test. */
  latencyTest?: boolean;
}

/** A video that goes on. Without colours, each picture's tells its number, see {@link numbered}. */
export interface PlayedVideo extends Pick<PictureOptions, 'colour' | 'quarters'> {
  /** From capture to the page, ms. */
  delayMs?: number;
  /** Whether it leaves out the capture of this number. */
  lacks?: readonly number[];
}

/** A camera's picture as a file. */
export interface PictureFile {
  format: PictureFormat;
  /** As the robot says, pixels. */
  width: number;
  height: number;
  base64: string;
}

const CAMERA_HEIGHT_M = 1;
/** A camera's optical frame that looks ahead: x, y, z, w. */
const AHEAD = [-0.5, 0.5, -0.5, 0.5] as const;

export class StageControl {
  readonly robot: ScriptedRobot;
  readonly videos = new ScriptedVideos();
  /** Decodes pictures; `null` before the first. */
  pictureWorker: PictureWorkerWatched | null = null;
  readonly #files = new Map<string, CloudFile>();
  #link: ScriptedLink | null = null;
  #app: App | null = null;
  #frameNumber = 0;
  #pictureId = 0;
  /** How many packets were sent. */
  #packets = 0;
  /** The header of each sensor's stream that the page knows. */
  readonly #announced = new Map<number, string>();
  #streaming: ReturnType<typeof setInterval> | undefined;
  #playing: ReturnType<typeof setInterval> | undefined;
  #picture: { width: number; height: number; pixels: Uint8Array } | null = null;

  constructor(robot: ScriptedRobot) {
    this.robot = robot;
  }

  get link(): ScriptedLink {
    if (this.#link === null) throw new Error('the page has opened no link');
    return this.#link;
  }

  set link(link: ScriptedLink) {
    this.#link = link;
  }

  get app(): App {
    if (this.#app === null) throw new Error('the page has not started');
    return this.#app;
  }

  set app(app: App) {
    this.#app = app;
  }

  /** The robot sends these. */
  tell(...messages: ToldMessage[]): void {
    for (const message of messages) this.robot.tell(message);
  }

  /** What the page has sent of these types since {@link forget}, in this order. */
  sent<Type extends SentMessage['type']>(...types: Type[]): Extract<SentMessage, { type: Type }>[] {
    return this.link.sent.filter((message): message is Extract<SentMessage, { type: Type }> =>
      (types as string[]).includes(message.type),
    );
  }

  forget(): void {
    this.link.sent.length = 0;
  }

  /** Loads a cloud that {@link cloud} can send then. */
  async load(name: string): Promise<void> {
    if (this.#files.has(name)) return;
    const response = await fetch(`stage/clouds/${name}.json`);
    if (!response.ok) throw new Error(`there is no cloud ${name}`);
    this.#files.set(name, (await response.json()) as CloudFile);
  }

  /** A frame of a cloud comes, seen from where the robot is now. @returns how many packets it has */
  cloud(name: string, options: CloudOptions = {}): number {
    const file = this.#files.get(name);
    if (file === undefined) throw new Error(`the cloud ${name} is not loaded`);
    const { lose = [], sensor = 0, ageMs = 0, heightM = CAMERA_HEIGHT_M, latencyTest = false } = options;
    const frameNumber = this.#frameNumber++;
    this.#announce(file, sensor);
    const packets = file.frames[(options.frame ?? frameNumber) % file.frames.length] ?? [];
    const { x, y, z, yaw } = this.robot.pose;
    const place = {
      ...{ frameNumber, sensor, latencyTest, captureUs: stampUsOf(this.robot.nowMs - ageMs) },
      position: [x, y, z + heightM] as const,
      orientation: turned(yaw, file.axes === 'body' ? [0, 0, 0, 1] : AHEAD),
    };
    for (const [i, packet] of packets.entries()) {
      const sequence = this.#packets++;
      if (!lose.includes(i)) this.link.receivePacket(placed(packet, place), sequence);
    }
    return packets.length;
  }

  /** A stream's header comes before its first packet, and when it changes. */
  #announce({ stream }: CloudFile, sensor: number): void {
    if (stream === undefined || this.#announced.get(sensor) === stream.header) return;
    this.#announced.set(sensor, stream.header);
    this.link.tell({ type: 'cloudStream', ...stream, ...(sensor === 0 ? {} : { sensor }) });
  }

  /** Sends a cloud again and again, until it is called with `null`. */
  stream(name: string | null, everyMs = 100): void {
    clearInterval(this.#streaming);
    if (name === null) return;
    const send = () => {
      if (this.link.phase === 'live' && !this.link.isCut) this.cloud(name);
    };
    this.#streaming = setInterval(send, everyMs);
  }

  /** A picture of a video comes. @returns whether the page takes it: it takes none of a video that is hidden */
  video(name: string, picture: PictureOptions = {}): boolean {
    if (this.link.phase !== 'live' || this.link.isCut) return false;
    const track = this.videos.offer(this.link, this.#videoOf(name));
    return this.videos.show(track, picture, this.robot.nowMs);
  }

  /** The browser refuses a video, e.g. because it does not know its codec. */
  refuseVideo(name: string): void {
    this.videos.offer(this.link, this.#videoOf(name), true);
  }

  /** Videos come again and again, all captured at the same instants, until it is called with `null`. */
  play(videos: Readonly<Record<string, PlayedVideo>> | null, everyMs = 100): void {
    clearInterval(this.#playing);
    if (videos === null) return;
    let number = 0;
    this.#playing = setInterval(() => {
      const [capture, atMs] = [number++, performance.now()];
      for (const [name, { delayMs = 0, lacks = [], ...picture }] of Object.entries(videos)) {
        if (lacks.includes(capture)) continue;
        const show = () =>
          this.video(name, { colour: numbered(capture), ...picture, ageMs: performance.now() - atMs });
        setTimeout(show, delayMs);
      }
    }, everyMs);
  }

  /**
   * A picture of a camera comes. Resolves once the page has drawn it, or has found it to be broken.
   *
   * @param ageMs how long before now it was taken
   */
  async picture(camera: number, { base64, ...facts }: PictureFile, ageMs = 0): Promise<void> {
    const bytes = bytesOf(base64);
    const pictureId = this.#pictureId++;
    const header = { ...facts, camera, pictureId, captureTimeUs: stampUsOf(this.robot.nowMs - ageMs) };
    const chunk = new Uint8Array(MAX_PICTURE_CHUNK_BYTES);
    for (let i = 0; i < pictureChunks(bytes.length); i++) {
      const length = writePictureChunk(header, bytes, i, chunk);
      this.link.receive('pictures', chunk.slice(0, length));
    }
    await this.pictureWorker?.decoded();
  }

  /** Nothing arrives any more, in either direction. */
  cut(): void {
    this.link.isCut = true;
  }

  restore(): void {
    this.link.isCut = false;
  }

  /** Keeps the next display frame, for {@link pixels}. */
  photograph(): void {
    this.#picture = null;
    this.app.frames.afterNextFrame(() => {
      const { gl } = this.app.stage;
      const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
      const pixels = new Uint8Array(4 * width * height);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      this.#picture = { width, height, pixels };
    });
  }

  #videoOf(name: string): number {
    const video = this.app.state.videos.switches.all.peek().findIndex((each) => each.name === name);
    if (video < 0) throw new Error(`the robot has no video ${name}`);
    return video;
  }

  get hasPicture(): boolean {
    return this.#picture !== null;
  }

  /**
   * A rectangle of the kept frame, row by row from the top left; shares of the canvas, 0–1.
   *
   * @returns red, green and blue of each pixel, as the characters of a string: the quickest way out of a browser
   */
  pixels({ x, y, width, height }: { x: number; y: number; width: number; height: number }): string {
    const picture = this.#picture;
    if (picture === null) throw new Error('no display frame is kept');
    const columns = spanOf(x, width, picture.width);
    const rows = spanOf(y, height, picture.height);
    let text = '';
    for (const row of rows)
      for (const column of columns) {
        const at = 4 * ((picture.height - 1 - row) * picture.width + column);
        text += String.fromCharCode(...picture.pixels.subarray(at, at + 3));
      }
    return btoa(text);
  }
}

/** Of a picture: its red tells its number, modulo 51. */
function numbered(capture: number): Rgb {
  return [(capture % 51) * 5, 0, 100];
}

function spanOf(from: number, share: number, size: number): number[] {
  const first = Math.min(Math.max(Math.floor(from * size), 0), size - 1);
  const count = Math.max(1, Math.min(Math.round(share * size), size - first));
  return Array.from({ length: count }, (_, i) => first + i);
}

/** The orientation of a camera on a robot that has turned. */
function turned(yaw: number, [x, y, z, w]: readonly [number, number, number, number]) {
  const [sin, cos] = [Math.sin(yaw / 2), Math.cos(yaw / 2)];
  return [cos * x - sin * y, cos * y + sin * x, cos * z + sin * w, cos * w - sin * z] as const;
}
