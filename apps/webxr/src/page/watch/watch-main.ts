import '../../panels/ui/wanted-language.ts';
import '../../panels/ui/theme.css';
import '../../panels/ui/ground.css';
import '../../panels/ui/style.css';
import '../../panels/ui/picture-panels.css';
import './watch.css';
import '../../panels/ui/layout.css';
import { transformSupport } from '@farpoint/operator';
import { applyDisplay } from '../../ground/display/stored-display.ts';
import { startLanguage } from '../../panels/ui/fill-texts.ts';
import type { Failure } from '../../state/notices.ts';
import { texts } from '../../words/language.ts';
import { WatchApp } from './watch-app.ts';
import { readWatchSettings } from './watch-settings.ts';

function byId<T extends HTMLElement>(id: string, kind: new () => T): T {
  const element = document.getElementById(id);
  if (!(element instanceof kind)) throw new Error(`the page has no <${kind.name}> with id ${id}`);
  return element;
}

const link = byId('link', HTMLElement);

function fail({ title, text }: Failure): void {
  const panel = byId('failure', HTMLElement);
  panel.hidden = false;
  link.hidden = true;
  (panel.querySelector('h1') as HTMLElement).textContent = title;
  (panel.querySelector('p') as HTMLElement).textContent = text;
}

function start(): void {
  applyDisplay();
  const settings = readWatchSettings(new URLSearchParams(window.location.search), window.location);
  const transform = transformSupport();
  if ('fault' in settings) {
    const { nothing, faults } = texts().watch;
    fail({ title: nothing, text: faults[settings.fault] });
    return;
  }
  if (typeof RTCPeerConnection === 'undefined' || transform === 'none') {
    fail(transform === 'none' ? texts().failures.noTransform : texts().failures.noWebRtc);
    return;
  }
  try {
    const app = new WatchApp(settings, transform, {
      stage: byId('stage', HTMLCanvasElement),
      link,
      pictures: byId('pictures', HTMLElement),
      view: byId('view', HTMLButtonElement),
      fromAbove: byId('from-above', HTMLButtonElement),
    });
    app.watcher.on('failed', ({ detail }) => {
      console.error('cloud worker:', detail);
      fail(texts().failures.workerFailed);
    });
    app.start();
    // The deployed page leaves this out. `vite build --mode testing` includes it.
    if (import.meta.env.MODE === 'testing')
      void import('../../testing/watch-api.ts').then(({ installWatchApi }) => installWatchApi(app));
  } catch (error) {
    console.error(error);
    fail(texts().failures.noWebGl2);
  }
}

async function open(): Promise<void> {
  await startLanguage();
  start();
}

void open();
