/** The page for those who watch: cameras and clouds together, and nothing that reaches the robot. */
import { CloudView, DrawingGovernor } from '@farpoint/cloud-view';
import {
  CloudHold,
  HeldClouds,
  noHold,
  RobotWatcher,
  type TransformSupport,
  type WatchState,
  watcherHold,
} from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, signal } from '@preact/signals-core';
import { type CameraView, STALE_MS } from '../../ground/pictures/camera-view.ts';
import { Switches } from '../../ground/switches.ts';
import { startLook } from '../../panels/ui/look-controls.ts';
import { SensorClouds } from '../../scene/view/sensor-clouds.ts';
import { Stage } from '../../scene/view/stage.ts';
import { Enlarged } from '../../state/enlarged.ts';
import { VideoFeed } from '../../take/video/video-feed.ts';
import { videoReceiver } from '../../take/video/video-receiver.ts';
import { VideoViews } from '../../take/video/video-views.ts';
import { texts } from '../../words/language.ts';
import type { WatchSettings } from './watch-settings.ts';
import { watchWords } from './watch-words.ts';

export interface WatchPanelsParts {
  readonly container: HTMLElement;
  readonly views: ReadonlySignal<readonly CameraView[]>;
  readonly enlarged: Enlarged;
  /** Whether anything arrives. */
  readonly live: ReadonlySignal<boolean>;
  /** Page's clock, ms, a few times a second. */
  readonly sampledAtMs: ReadonlySignal<number>;
}

/** The cameras beside the scene: name, whether it is live, and a button that shows or hides the camera. */
function showWatchPanels({ container, views, enlarged, live, sampledAtMs }: WatchPanelsParts): void {
  const panels = computed(() => views.value.map((view) => panelOf(view, () => enlarged.toggle(view))));
  effect(() => {
    container.replaceChildren(...panels.value.map(({ figure }) => figure));
    container.hidden = panels.value.length === 0;
  });
  effect(() => {
    const nowMs = sampledAtMs.value;
    for (const { view, figure, status, fault, button } of panels.value) {
      const shown = view.camera.on.value;
      const newest = view.newest.peek();
      const silentMs = newest === null ? null : nowMs - newest.drawnAtMs;
      const isLive = live.value && silentMs !== null && silentMs < STALE_MS;
      const wrong = view.fault.value;
      status.textContent = !shown ? texts().watch.cameraHidden : statusWords(isLive, silentMs);
      fault.textContent = wrong;
      fault.hidden = !shown || wrong === null;
      figure.dataset.state = shown ? stateOf(isLive, newest !== null, wrong !== null) : 'off';
      figure.dataset.enlarged = String(enlarged.view.value === view);
      view.canvas.hidden = !shown || newest === null;
      button.textContent = shown ? '–' : '+';
      const { hide, show } = texts().clouds;
      button.ariaLabel = (shown ? hide : show)(view.camera.name);
    }
  });
}

/** As on the operator's page: what is not live has no colours. */
function stateOf(isLive: boolean, hasPicture: boolean, isFaulty: boolean): string {
  if (isFaulty) return 'fault';
  if (isLive) return 'live';
  return hasPicture ? 'frozen' : 'waiting';
}

function statusWords(isLive: boolean, silentMs: number | null): string {
  const said = texts().watch;
  if (isLive) return said.cameraLive;
  return silentMs === null ? said.cameraWaiting : said.cameraSilent((silentMs / 1000).toFixed(0));
}

function panelOf(view: CameraView, onEnlarge: () => void) {
  const figure = document.createElement('figure');
  figure.dataset.video = String(view.camera.index);
  const caption = document.createElement('figcaption');
  const name = document.createElement('span');
  name.className = 'name';
  name.textContent = view.camera.name;
  name.title = view.camera.name;
  const status = document.createElement('span');
  status.className = 'age';
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.addEventListener('click', () => view.toggle());
  const fault = document.createElement('p');
  fault.className = 'fault';
  view.canvas.title = texts().clouds.enlargeTitle;
  view.canvas.onclick = onEnlarge;
  caption.append(name, status, button);
  figure.append(caption, fault, view.canvas);
  return { view, figure, status, fault, button };
}

/** The page's elements. */
export interface WatchElements {
  readonly stage: HTMLCanvasElement;
  readonly link: HTMLElement;
  readonly pictures: HTMLElement;
  readonly view: HTMLButtonElement;
  readonly fromAbove: HTMLButtonElement;
}

/** How often figures are renewed, ms: as often as people can read. */
const SAMPLE_MS = 250;

export class WatchApp {
  readonly watcher: RobotWatcher;
  readonly videos: VideoFeed;
  readonly cloud: CloudView;
  /** Clouds wait here for the videos that were captured with them. */
  readonly hold: CloudHold;
  readonly views: VideoViews;
  /** Display frames drawn. */
  drawnFrames = 0;
  readonly #elements: WatchElements;
  readonly #stage: Stage;
  readonly #clouds: SensorClouds;
  readonly #held: HeldClouds;
  readonly #enlarged: Enlarged;
  readonly #governor = new DrawingGovernor();
  readonly #state = signal<WatchState>({ phase: 'connecting', obstacle: null, detail: '' });
  readonly #name = signal<string | null>(null);
  readonly #nowMs = signal(performance.now());
  #framesBefore = 0;

  /** @throws {Error} without WebGL 2 */
  constructor(settings: WatchSettings, transform: TransformSupport, elements: WatchElements) {
    this.#elements = elements;
    this.#stage = new Stage(elements.stage, null);
    const { renderer, world } = this.#stage;
    const { url, mountpoint, pin, synchronised } = settings;
    const watcher = new RobotWatcher({ url, mountpoint, pin, transform });
    this.watcher = watcher;
    this.views = new VideoViews(this.#nowMs, () => document.createElement('canvas'));
    this.#enlarged = new Enlarged(this.views.views);
    this.videos = new VideoFeed({
      client: watcher,
      views: this.views,
      words: texts().media.cannotShow,
      settings,
      presented: null,
      // Its frames tell the timestamps with which the relay's were paired.
      receiver: videoReceiver('native'),
      captureMs: (video, { rtpTimestamp }) =>
        rtpTimestamp === null ? null : watcher.captureMsOf(video, rtpTimestamp),
      now: () => performance.now(),
    });
    this.hold = new CloudHold(synchronised ? watcherHold : noHold);
    this.#held = new HeldClouds(watcher, this.hold, () => performance.now());
    const held = this.#held;
    this.cloud = new CloudView(renderer, held);
    world.add(this.cloud);
    const sensors = new Switches();
    watcher.on('sensors', (each) => sensors.set(each));
    const [first, pointScale] = [this.cloud, signal(1)];
    this.#clouds = new SensorClouds({ renderer, world, client: held, first, sensors, pointScale });
  }

  get state(): WatchState {
    return this.#state.peek();
  }

  start(): void {
    const { watcher } = this;
    const { stage: canvas } = this.#elements;
    watcher.on('session', () => {
      this.views.clear();
      this.#stage.forgetPose();
    });
    watcher.on('broadcast', ({ name }) => {
      this.#name.value = name;
    });
    watcher.on('videos', (videos) => this.views.list(videos));
    watcher.on('watching', (state) => {
      this.#state.value = state;
    });
    this.#show();
    startLook(canvas, this.#stage);
    new ResizeObserver(() => this.#stage.resize()).observe(canvas);
    setInterval(() => this.#sample(), SAMPLE_MS);
    this.#stage.renderer.setAnimationLoop((nowMs) => this.#frame(nowMs));
    watcher.start();
  }

  #show(): void {
    const { link, pictures, view, fromAbove } = this.#elements;
    const { look } = this.#stage;
    effect(() => {
      const { text, tone } = watchWords(this.#state.value, this.#name.value);
      link.textContent = text;
      link.dataset.tone = tone;
    });
    showWatchPanels({
      container: pictures,
      views: this.views.views,
      enlarged: this.#enlarged,
      sampledAtMs: this.#nowMs,
      live: computed(() => this.#state.value.phase === 'live'),
    });
    const switchAbove = (above: boolean): void => {
      look.fromAbove = above;
      fromAbove.ariaPressed = String(above);
    };
    fromAbove.addEventListener('click', () => switchAbove(!look.fromAbove));
    view.addEventListener('click', () => {
      if (look.fromAbove) switchAbove(false);
      else look.switchMode();
    });
    window.addEventListener('keydown', ({ code, ctrlKey, metaKey, altKey }) => {
      if (ctrlKey || metaKey || altKey) return;
      if (code === 'KeyT') fromAbove.click();
      else if (code === 'KeyV') view.click();
      else if (code === 'KeyC') look.recentre();
      else if (code === 'KeyE') this.#enlarged.next();
    });
  }

  #sample(): void {
    const nowMs = performance.now();
    this.#nowMs.value = nowMs;
    this.videos.measure(nowMs);
    const framesPerSecond = ((this.drawnFrames - this.#framesBefore) * 1000) / SAMPLE_MS;
    this.#framesBefore = this.drawnFrames;
    if (document.hidden || this.#state.peek().phase !== 'live') this.#governor.pause();
    else if (this.#governor.update(framesPerSecond, nowMs)) {
      const { scale, every } = this.#governor.step;
      this.#stage.resolution = scale;
      this.watcher.drawEvery(every);
      this.#clouds.every = every;
    }
  }

  #frame(nowMs: number): void {
    const beganMs = performance.now();
    this.videos.present(beganMs);
    this.#held.advance(this.videos.shownMs, beganMs);
    this.cloud.update(beganMs);
    this.#clouds.update(beganMs);
    const { renderer, scene, viewCamera } = this.#stage;
    this.#stage.prepare(this.cloud, nowMs);
    renderer.render(scene, viewCamera);
    this.drawnFrames++;
  }
}
