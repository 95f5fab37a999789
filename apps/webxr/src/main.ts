import './panels/ui/wanted-language.ts';
import './panels/ui/theme.css';
import './panels/ui/ground.css';
import './panels/ui/style.css';
import './panels/ui/cloud-panel.css';
import './panels/ui/picture-panels.css';
import './panels/ui/sound.css';
import './panels/ui/minimap.css';
import './panels/ui/near.css';
import './panels/ui/banner.css';
import './panels/ui/stop.css';
import './panels/ui/messages.css';
import './panels/ui/small-screens.css';
import './panels/ui/settings.css';
import './panels/ui/people.css';
import './panels/ui/inputs.css';
import './panels/ui/commands.css';
import './panels/ui/robots.css';
import './panels/ui/layout.css';
import { isSoftwareRenderer } from '@farpoint/cloud-view';
import { transformSupport } from '@farpoint/operator';
import { readBenchSettings } from './ground/bench-settings.ts';
import { applyDisplay, displaySettings } from './ground/display/stored-display.ts';
import { keepAwake } from './ground/display/wake-lock.ts';
import { liveSettings } from './ground/live-settings.ts';
import { readSettings } from './ground/settings.ts';
import { hideToken, loadStored, pageOrigin } from './ground/stored-settings.ts';
import { App } from './page/app.ts';
import { elements } from './panels/ui/elements.ts';
import { startLanguage } from './panels/ui/fill-texts.ts';
import { showNotices } from './panels/ui/notice.ts';
import { Notices } from './state/notices.ts';
import type { OpenedStage } from './testing/open-stage.ts';
import { texts } from './words/language.ts';

const query = new URLSearchParams(window.location.search);
// The deployed page leaves this out. `pnpm dev` and `vite build --mode testing` include it.
const bench = import.meta.env.MODE === 'production' ? undefined : readBenchSettings(query);
const settings = liveSettings(readSettings(query, loadStored(), pageOrigin(), bench), pageOrigin());
hideToken(settings);
applyDisplay();
const notices = new Notices();

function start(stage: OpenedStage | null): void {
  const transform = transformSupport();
  const isDirect = settings.bridge === null;
  if (isDirect && typeof RTCPeerConnection === 'undefined') {
    notices.failure.value = texts().failures.noWebRtc;
    return;
  }
  if (isDirect && transform === 'none') {
    notices.failure.value = texts().failures.noTransform;
    return;
  }
  try {
    const app = new App(settings, transform, notices, stage?.openLink);
    stage?.attach(app);
    app.start();
    keepAwake(app.state.link.live, () => displaySettings.value.awake);
    elements.noGpu.hidden = !isSoftwareRenderer(app.stage.gl);
    // The deployed page leaves this out, too.
    if (import.meta.env.MODE !== 'production')
      void import('./testing/test-hooks.ts').then(({ installTestApi }) => {
        installTestApi(app);
        stage?.opened();
      });
  } catch (error) {
    console.error(error);
    notices.failure.value = texts().failures.noWebGl2;
  }
}

// The server says where its page may connect to. Without this, a forbidden address only looks unreachable.
document.addEventListener('securitypolicyviolation', ({ effectiveDirective, blockedURI }) => {
  if (effectiveDirective === 'connect-src')
    notices.tell(texts().failures.forbiddenAddress(blockedURI), 'bad');
});
async function open(): Promise<void> {
  await startLanguage();
  showNotices(notices);
  // The deployed page leaves this out, too. A page of tests can have a scripted link instead of a robot.
  if (import.meta.env.MODE !== 'production' && query.has('stage'))
    start(await (await import('./testing/open-stage.ts')).openStage());
  else start(null);
}

void open();
