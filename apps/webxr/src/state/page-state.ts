/**
 * What the page shows, as signals. The client's events end here: panels and the VR view read signals by `effect`, hands and
 * buttons write them or call the client. What changes with every display frame, and what commands are made of, is no signal.
 */
import type { RobotClient } from '@farpoint/operator';
import { effect, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';
import { CameraPictures } from '../pictures/camera-pictures.ts';
import type { Settings } from '../settings.ts';
import type { PageStats } from '../status/page-stats.ts';
import { type DrivingState, drivingState } from './driving-state.ts';
import { type LinkState, linkState } from './link-state.ts';
import type { Notices } from './notices.ts';
import { type RobotState, robotState } from './robot-state.ts';
import { Sampler } from './sampler.ts';
import { Switches } from './switches.ts';

/** Events after which people must see at once how things stand; the rest is sampled a few times a second. */
const SAMPLED = ['signaling', 'robots', 'phase', 'path', 'session', 'lease', 'estop'] as const;

export interface PageStateParts {
  readonly client: RobotClient;
  readonly settings: Pick<Settings, 'signalingFault' | 'pointScale'>;
  readonly notices: Notices;
  /** The figures of the stream and of the drawing, now. */
  figures(): PageStats;
  /** Page's clock, ms. */
  now(): number;
  newCanvas(): HTMLCanvasElement;
}

export class PageState {
  readonly notices: Notices;
  readonly link: LinkState;
  readonly robot: RobotState;
  readonly driving: DrivingState;
  readonly figures: ReadonlySignal<PageStats>;
  /** The sensors of a robot that has several, and whose clouds are wanted. */
  readonly sensors = new Switches();
  /** The robot's cameras, and whose pictures are shown. */
  readonly cameras = new Switches();
  readonly pictures: CameraPictures;
  /** Of points, relative to what they stand for. */
  readonly pointScale: Signal<number>;
  /** Whether anybody can see the page. */
  readonly looking = signal(true);
  readonly #samples = new Sampler();
  readonly #now: () => number;

  constructor({ client, settings, notices, figures, now, newCanvas }: PageStateParts) {
    this.#now = now;
    this.notices = notices;
    this.link = linkState(client, this.#samples, settings.signalingFault);
    this.robot = robotState(client, this.#samples);
    this.driving = drivingState(client, this.#samples);
    this.figures = this.#samples.of(figures);
    this.pictures = new CameraPictures(this.cameras, this.#samples.atMs, newCanvas);
    this.pointScale = signal(settings.pointScale);
    this.sample();
    this.#listen(client);
    this.#ask(client);
  }

  /** Shows people how things stand now; also a few times a second, for what changes with time. */
  sample(): void {
    this.#samples.take(this.#now());
  }

  #listen(client: RobotClient): void {
    for (const type of SAMPLED) client.on(type, () => this.sample());
    client.on('session', () => {
      this.cameras.set([]);
      this.sensors.set([]);
    });
    client.on('cameras', (cameras) => this.cameras.set(cameras));
    client.on('sensors', (sensors) => this.sensors.set(sensors));
    client.on('picture', (picture) => this.pictures.show(picture, this.#now()));
    client.on('pictureFault', ({ camera, detail }) => this.pictures.onFault(camera, detail));
  }

  /** What is switched off, or looked at by nobody, costs the link nothing. */
  #ask(client: RobotClient): void {
    effect(() => {
      const watched = this.looking.value ? this.cameras.wanted.value : [];
      if (this.cameras.all.value.length > 0) client.watch(watched);
    });
    effect(() => {
      const wanted = this.sensors.wanted.value;
      if (this.sensors.all.value.length > 0) client.wantClouds(wanted);
    });
  }
}
