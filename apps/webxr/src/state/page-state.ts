/**
 * What the page shows, as signals. The client's events are adapted to signals here. Panels and the VR view read the
 * signals in an `effect`; controls write them or call the client. Whatever changes with every display frame, and
 * whatever commands are made of, is not a signal.
 */
import type { RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, type Signal, signal } from '@preact/signals-core';
import type { PanelPlacements } from '../ground/panels/panel-placements.ts';
import { CameraPictures } from '../ground/pictures/camera-pictures.ts';
import type { CameraView } from '../ground/pictures/camera-view.ts';
import type { Settings } from '../ground/settings.ts';
import { Switches } from '../ground/switches.ts';
import { VideoViews } from '../take/video/video-views.ts';
import { takenOverWords } from '../words/driving-words.ts';
import { driverWords } from '../words/handover-words.ts';
import type { PageStats } from '../words/page-stats.ts';
import { holderWords } from '../words/words.ts';
import { CommandsState } from './commands-state.ts';
import { Enlarged } from './enlarged.ts';
import { LinkPriority } from './link-priority.ts';
import { isRobotHeard, type LinkState, linkState, robotSilence } from './link-state.ts';
import type { Notices } from './notices.ts';
import { PeopleState } from './people-state.ts';
import { comesPoints, type RobotState, robotState } from './robot-state.ts';
import { Sampler } from './sampler.ts';
import { SoundState } from './sound-state.ts';
import { StopNews } from './stop-news.ts';
import { Takeover } from './takeover.ts';

/** Which camera has changed places with the cloud: it fills the screen, and the cloud is in its panel. */
export class Staged {
  readonly #chosen = signal<CameraView | null>(null);
  readonly #shown: ReadonlySignal<readonly CameraView[]>;

  /** `null` if none has, also when the chosen camera has been switched off, or there is no session. */
  readonly view: ReadonlySignal<CameraView | null>;

  /** @param live whether there is a session */
  constructor(views: ReadonlySignal<readonly CameraView[]>, live: ReadonlySignal<boolean>) {
    this.#shown = computed(() => views.value.filter(({ camera }) => camera.on.value));
    this.view = computed(() => {
      const chosen = this.#chosen.value;
      return chosen !== null && live.value && this.#shown.value.includes(chosen) ? chosen : null;
    });
  }

  /** Lets this camera fill the screen, or the cloud again. */
  toggle(view: CameraView): void {
    this.#chosen.value = this.view.peek() === view ? null : view;
  }

  /** The same for the camera that is enlarged, or else the first that is shown. */
  swap(enlarged: CameraView | null): void {
    const view = this.view.peek() ?? enlarged ?? this.#shown.peek()[0];
    if (view !== undefined) this.toggle(view);
  }
}

export type DrivingState = ReturnType<typeof drivingState>;

/** Who drives the robot, and what this operator may do. */
function drivingState({ driver, link }: RobotClient, samples: Sampler) {
  const holder = samples.of(() => driver.holder);
  const role = samples.of(() => link.session.welcome?.access?.role ?? null);
  return {
    holder,
    /** Whether a grip is held with which this operator drives, or would. */
    gripped: samples.of(() => driver.stream.held),
    /** By this operator's grant; `null` if the robot asks for none. */
    role,
    /** Whether this operator may take the lease from another. */
    mayTake: computed(() => holder.value === 'other' && role.value !== 'watch'),
    /** Who drives, in a few words. */
    line: samples.of((atMs) =>
      holderWords({
        heard: link.phase !== 'live' || (isRobotHeard(link, atMs) && !link.interrupted),
        holder: driver.holder,
        driver: driverWords(link.session.lease, link.session.operators),
        role: link.session.welcome?.access?.role ?? null,
        device: driver.stream.held ? (driver.input?.name ?? '') : null,
        gripLost: driver.lost,
        paused: driver.paused,
        stopped: link.session.estop.latched,
      }),
    ),
  };
}

/**
 * Events that take a sample at once, so that people see the new state. Otherwise samples are taken a few times a
 * second.
 */
const SAMPLED = [
  'signaling',
  'robots',
  'phase',
  'path',
  'session',
  'lease',
  'operators',
  'handover',
  'estop',
  'stop',
  'alarm',
  'commands',
] as const;

export interface PageStateParts {
  readonly client: RobotClient;
  readonly settings: Pick<Settings, 'signalingFault' | 'signalingUrl' | 'pointScale' | 'barcode'>;
  readonly notices: Notices;
  readonly placements: PanelPlacements;
  /** Current figures of the stream and of the drawing. */
  figures(): PageStats;
  /** Page's clock, ms. */
  now(): number;
  /** Whether the browser believes that it has a network. */
  isOnline(): boolean;
  newCanvas(): HTMLCanvasElement;
}

export class PageState {
  readonly notices: Notices;
  readonly link: LinkState;
  readonly robot: RobotState;
  readonly driving: DrivingState;
  readonly people: PeopleState;
  /** What the robot can be made to do besides driving, and its recording. */
  readonly commands: CommandsState;
  /** Tells of STOPs and releases by others. */
  readonly stopNews: StopNews;
  readonly figures: ReadonlySignal<PageStats>;
  /** The sensors of a robot that has several, and which of them should send clouds. */
  readonly sensors = new Switches();
  /** Elevations of the rings of each LiDAR whose rings the robot knows, radians, by the sensor's number. */
  readonly rings = signal<ReadonlyMap<number, readonly number[]>>(new Map());
  /** The robot's cameras that send single pictures, and which of them are shown. */
  readonly cameras = new Switches();
  readonly pictures: CameraPictures;
  /** The robot's cameras that send videos, and which of them are shown. */
  readonly videos: VideoViews;
  /** What is shown of all cameras: videos, then pictures. */
  readonly views: ReadonlySignal<readonly CameraView[]>;
  readonly enlarged: Enlarged;
  readonly priority: LinkPriority;
  /** Which of the cameras fills the screen in place of the cloud. */
  readonly staged: Staged;
  /** Where the operator has put the cameras' panels. */
  readonly placements: PanelPlacements;
  /** The robot's microphone, and the operator's voice. */
  readonly sound: SoundState;
  /** When the values that change with time were read last: page's clock, ms. */
  readonly sampledAtMs: ReadonlySignal<number>;
  /** Size of the points, relative to the patch of surface that each stands for. */
  readonly pointScale: Signal<number>;
  /** Whether the page is visible to anybody. */
  readonly looking = signal(true);
  /** Who has taken the drive from a hand that holds on. */
  readonly takeover = new Takeover();
  readonly #samples = new Sampler();
  readonly #now: () => number;
  readonly #client: RobotClient;

  constructor({ client, settings, notices, placements, figures, now, newCanvas, isOnline }: PageStateParts) {
    this.#now = now;
    this.#client = client;
    this.notices = notices;
    const { signalingFault, signalingUrl } = settings;
    const { takeover } = this;
    takeover.follow(client, (name) => notices.tell(takenOverWords(name), 'warning'));
    const { host } = new URL(signalingUrl);
    this.link = linkState({ client, samples: this.#samples, host, takeover, signalingFault, isOnline });
    this.robot = robotState(client, this.#samples);
    this.driving = drivingState(client, this.#samples);
    this.people = new PeopleState(client, this.#samples);
    this.commands = new CommandsState({
      client,
      samples: this.#samples,
      tell: ({ text, tone }) => notices.tell(text, tone),
      now,
    });
    this.stopNews = new StopNews(client, notices);
    this.figures = this.#samples.of(figures);
    this.sampledAtMs = this.#samples.atMs;
    this.pictures = new CameraPictures(this.cameras, this.sampledAtMs, newCanvas);
    this.videos = new VideoViews(this.sampledAtMs, newCanvas);
    this.views = computed(() => [...this.videos.views.value, ...this.pictures.views.value]);
    this.enlarged = new Enlarged(this.views);
    this.priority = new LinkPriority(
      computed(() => this.videos.switches.all.value.length),
      computed(() => {
        const view = this.enlarged.view.value;
        return view?.kind === 'video' ? view.camera.index : null;
      }),
    );
    this.staged = new Staged(this.views, this.link.live);
    this.placements = placements;
    this.sound = new SoundState(client);
    this.pointScale = signal(settings.pointScale);
    this.sample();
    this.#listen(client);
    this.#ask(client, settings.barcode);
  }

  /** Updates the signals now. Also called a few times a second, for values that change with time. */
  sample(): void {
    this.#samples.take(this.#now());
  }

  /**
   * Samples at once if the robot has fallen silent or is heard again since the last sample. Call it as often as hands are
   * read: figures must not look live any longer than they are.
   */
  followSilence(nowMs: number): void {
    const { link, robot } = this;
    const isSame =
      robotSilence(this.#client.link, nowMs) === link.silence.peek() &&
      comesPoints(this.#client, nowMs) === robot.pointsHeard.peek();
    if (!isSame) this.sample();
  }

  /** Lets the camera fill the screen, or the cloud again; without one, the enlarged camera or the first. */
  swap(view?: CameraView): void {
    const { staged, enlarged } = this;
    if (view === undefined) staged.swap(enlarged.view.peek());
    else staged.toggle(view);
    // Its panel has the cloud now, at its usual size.
    const filling = staged.view.peek();
    if (filling !== null && filling === enlarged.view.peek()) enlarged.toggle(filling);
  }

  /** Shows the camera larger: enlarged, then in place of the cloud, then at its usual size. */
  nextSize(view: CameraView): void {
    const isLarge = this.staged.view.peek() === view || this.enlarged.view.peek() === view;
    if (isLarge) this.swap(view);
    else {
      // One in front at a time.
      const before = this.staged.view.peek();
      if (before !== null) this.staged.toggle(before);
      this.enlarged.toggle(view);
    }
  }

  #listen(client: RobotClient): void {
    for (const type of SAMPLED) client.on(type, () => this.sample());
    client.on('session', () => {
      this.cameras.set([]);
      this.sensors.set([]);
      this.rings.value = new Map();
      this.videos.clear();
    });
    client.on('cameras', (cameras) => this.cameras.set(cameras));
    client.on('videos', (videos) => this.videos.list(videos));
    client.on('sensors', (sensors) => this.sensors.set(sensors));
    client.on('rings', ({ sensor, elevations }) => {
      this.rings.value = new Map(this.rings.peek()).set(sensor, elevations);
    });
    client.on('picture', (picture) => this.pictures.show(picture, this.#now()));
    client.on('pictureFault', ({ camera, detail }) => this.pictures.onFault(camera, detail));
  }

  /** A camera or sensor that is switched off or that nobody looks at takes nothing of the link. */
  #ask(client: RobotClient, barcode: boolean): void {
    effect(() => {
      const watched = this.looking.value ? this.cameras.wanted.value : [];
      if (this.cameras.all.value.length > 0) client.watch(watched);
    });
    effect(() => {
      const { all, wanted } = this.videos.switches;
      const watched = this.looking.value ? wanted.value : [];
      if (all.value.length > 0) client.watchVideos(watched, barcode);
    });
    effect(() => {
      const { cloud, videos } = this.priority.shares.value;
      if (this.videos.switches.all.value.length > 0) client.shareLink(cloud, videos);
    });
    effect(() => {
      const wanted = this.sensors.wanted.value;
      if (this.sensors.all.value.length > 0) client.wantClouds(wanted);
    });
  }
}
