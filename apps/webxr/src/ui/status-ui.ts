/** What the page shows of the link, the robot and the stream, a few times a second: on the screen and on the wrist. */
import { robotAfter } from '@farpoint/operator';
import type { PageParts } from '../page-parts.ts';
import type { CameraViews } from '../pictures/camera-views.ts';
import { STALE_MS } from '../pictures/camera-views.ts';
import type { PageStats } from '../status/page-stats.ts';
import { type ShownReading, shownReading } from '../status/shown-readings.ts';
import { driveWords, linkWords, type Words } from '../status/words.ts';
import type { WristPanel } from '../view/wrist-panel.ts';
import { WristPictures } from '../view/wrist-pictures.ts';
import { elements } from './elements.ts';
import { type Fact, showFacts } from './facts.ts';
import { PicturePanels } from './picture-panels.ts';
import { showRobotSwitcher } from './robot-switcher.ts';

export class StatusUi {
  readonly #app: PageParts;
  readonly #wrist: WristPanel;
  readonly #cameras: CameraViews;
  readonly #panels: PicturePanels;
  readonly #wristPictures = new WristPictures();

  constructor(app: PageParts, wrist: WristPanel, cameras: CameraViews) {
    this.#app = app;
    this.#wrist = wrist;
    this.#cameras = cameras;
    this.#panels = new PicturePanels(cameras);
    wrist.addBeside(this.#wristPictures.object);
  }

  onVr(active: boolean): void {
    elements.vr.textContent = active ? 'Leave VR' : 'Enter VR';
    this.#wrist.visible = active;
  }

  /** Other cameras, or others of them shown. */
  onCameras(): void {
    this.#panels.rebuild();
    this.#wristPictures.setViews(this.#cameras.views);
  }

  /** What pictures show changes with each of them, and with time. */
  updatePictures(nowMs: number): void {
    this.#panels.update(nowMs);
    if (!this.#app.vr.active) return;
    this.#wristPictures.update((view) => (this.#cameras.ageMs(view, nowMs) ?? 0) > STALE_MS);
  }

  /** In VR. @param progress of the hold that releases the emergency stop, 0–1 */
  showRelease(progress: number): void {
    this.#wrist.showProgress(progress);
  }

  update(nowMs: number): void {
    const { client, settings } = this.#app;
    const { link } = client;
    const words =
      settings.signalingFault !== null && link.phase === 'none'
        ? ({ text: `Signaling address: ${settings.signalingFault}`, tone: 'bad' } as const)
        : describeLink(this.#app, nowMs);
    setPill(elements.link, words);
    const connected = link.phase !== 'none';
    elements.robots.hidden = connected;
    elements.disconnect.hidden = !connected;
    showRobotSwitcher(link.robots, client.chosenRobotId);
    elements.view.hidden = !connected;
    elements.drive.hidden = link.phase !== 'live';
    elements.hud.hidden = link.phase !== 'live';
    if (link.phase === 'live') this.#showSession(nowMs);
    if (this.#app.vr.active) this.#showWrist(words);
    this.updatePictures(nowMs);
  }

  #showSession(nowMs: number): void {
    const { driver } = this.#app.client;
    setPill(elements.holder, this.#holderWords());
    elements.take.hidden = driver.holder !== 'other';
    elements.release.hidden = driver.holder !== 'you';
    showFacts(this.#facts(nowMs));
  }

  #holderWords(): Words {
    const { driver } = this.#app.client;
    if (driver.holder === 'other') return { text: 'Someone else drives', tone: 'warning' };
    if (driver.holder === 'nobody') return { text: 'Nobody drives', tone: 'neutral' };
    return driver.stream.held
      ? { text: `You drive (${driver.input?.name ?? ''})`, tone: 'good' }
      : { text: 'You may drive', tone: 'good' };
  }

  #facts(nowMs: number): Fact[] {
    const { link } = this.#app.client;
    const { telemetry, estop, welcome } = link.session;
    const stats = this.#stats();
    const facts: Fact[] = [];
    if (welcome !== null) facts.push({ name: 'Robot', value: welcome.name });
    if (telemetry !== null) {
      // Telemetry tells of a stop a moment later.
      const drive = driveWords[estop.latched ? 'estop' : telemetry.drive];
      const by = estop.latched && estop.by !== undefined ? ` (by ${estop.by})` : '';
      facts.push({ name: 'State', value: drive.text + by, tone: drive.tone });
      const { linear, angular } = telemetry.twist;
      facts.push({ name: 'Speed', value: `${linear.x.toFixed(2)} m/s  ${angular.z.toFixed(2)} rad/s` });
      if (telemetry.battery !== undefined) {
        const share = telemetry.battery.percentage;
        facts.push({
          name: 'Battery',
          value: `${Math.round(share * 100)} %  ${telemetry.battery.voltage.toFixed(1)} V`,
          tone: share < 0.1 ? 'bad' : share < 0.25 ? 'warning' : 'neutral',
        });
      }
    }
    addReadings(facts, link.session.readings.list(nowMs).map(shownReading));
    facts.push(...streamFacts(stats));
    if (telemetry !== null && telemetry.operators > 1) {
      facts.push({ name: 'Operators', value: String(telemetry.operators) });
    }
    return facts;
  }

  #showWrist(words: Words): void {
    const stats = this.#stats();
    const { chosenRobotId, link } = this.#app.client;
    const { telemetry } = link.session;
    const next = robotAfter(link.robots, chosenRobotId);
    const drive = telemetry === null ? null : driveWords[telemetry.drive];
    const battery = telemetry?.battery;
    this.#wrist.show([
      words,
      ...(drive === null ? [] : [drive]),
      this.#holderWords(),
      {
        text: `${(stats.pointsPerFrame / 1000).toFixed(1)}k points  ${stats.framesPerSecond.toFixed(0)}/s  ${mbps(stats)} Mbit/s`,
        tone: 'neutral',
      },
      {
        text: `rtt ${ms(stats.minRttMs)}  frame ${ms(stats.frameLatencyMs?.p50)}  loss ${(stats.lossRate * 100).toFixed(1)} %`,
        tone: stats.lossRate > 0.05 ? 'warning' : 'neutral',
      },
      link.session.estop.latched
        ? { text: 'Open hand, hold trigger 1 s: release', tone: 'bad' }
        : {
            text: [
              battery === undefined
                ? 'Squeeze: drive  B: stop'
                : `Battery ${Math.round(battery.percentage * 100)} %`,
              ...(next === null ? [] : [`press stick: ${next.name}`]),
            ].join('  '),
            tone: 'neutral',
          },
    ]);
  }

  #stats(): PageStats {
    return snapshot(this.#app);
  }
}

/** The page's figures now. */
export function snapshot(app: PageParts): PageStats {
  return app.stats.snapshot(app.client.stats(), app.cloud, app.stage.renderer.domElement);
}

export function describeLink(app: PageParts, nowMs: number): Words {
  const { link } = app.client;
  return linkWords({
    phase: link.phase,
    signaling: link.signaling,
    robotListed: link.robotListed,
    lastLoss: link.lastLoss,
    maxOperators: link.maxOperators,
    silentMs: link.silentMs(nowMs),
    pointsSilentMs: nowMs - app.client.pointsAtMs,
    rateByReports: link.session.telemetry?.stream.feedback === 'reports',
  });
}

function streamFacts(stats: PageStats): Fact[] {
  const facts: Fact[] = [
    {
      name: 'Points',
      value: `${Math.round(stats.pointsPerFrame).toLocaleString('en')} × ${stats.framesPerSecond.toFixed(0)}/s`,
    },
    { name: 'Rate', value: `${mbps(stats)} Mbit/s` },
    {
      name: 'Loss',
      value: `${(stats.lossRate * 100).toFixed(1)} %`,
      tone: stats.lossRate > 0.05 ? 'warning' : 'neutral',
    },
    { name: 'Round trip', value: ms(stats.minRttMs) },
    { name: 'Frame age', value: ms(stats.frameLatencyMs?.p50) },
  ];
  if (stats.mtpMs !== null) {
    facts.push({ name: 'Motion to photon', value: `${ms(stats.mtpMs.p50)}  p95 ${ms(stats.mtpMs.p95)}` });
  }
  return facts;
}

/** A reading of the battery says more than the telemetry's two figures; any other name that is there already stays whose it is. */
function addReadings(facts: Fact[], readings: readonly ShownReading[]): void {
  for (const { topic, label, text, tone } of readings) {
    const there = facts.find(({ name }) => name === label);
    if (there !== undefined && label === 'Battery') Object.assign(there, { value: text, tone });
    else facts.push({ name: there === undefined ? label : `${label} (${topic})`, value: text, tone });
  }
}

function mbps(stats: PageStats): string {
  return (stats.bitsPerSecond / 1e6).toFixed(1);
}

function ms(value: number | null | undefined): string {
  return value === null || value === undefined ? '–' : `${value.toFixed(0)} ms`;
}

function setPill(element: HTMLElement, words: Words): void {
  if (element.textContent !== words.text) element.textContent = words.text;
  element.dataset.tone = words.tone;
}
