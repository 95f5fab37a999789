import '../../panels/ui/wanted-language.ts';
import '../../panels/ui/theme.css';
import '../../panels/ui/ground.css';
import './wall.css';
import { applyDisplay } from '../../ground/display/stored-display.ts';
import { readWallSettings } from '../../ground/wall/wall-settings.ts';
import { startLanguage } from '../../panels/ui/fill-texts.ts';
import { texts } from '../../words/language.ts';
import { Wall } from './wall.ts';
import { buildWall } from './wall-parts.ts';

async function open(): Promise<void> {
  applyDisplay();
  await startLanguage();
  document.title = texts().wall.title;
  const parts = buildWall();
  document.body.append(parts.bar, parts.cells);
  const settings = readWallSettings(new URLSearchParams(window.location.search));
  new Wall(parts, settings, () => performance.now()).start();
}

void open();
