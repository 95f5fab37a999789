import { renderSVG } from 'uqr';
import { escapeHtml, page } from './page.ts';

/** Where the authority's certificate is, on the service's page for it. */
export const CERTIFICATE_PATH = '/farpoint-authority.crt';

/**
 * Says how a headset or a phone comes to trust this service: the page that it opens without TLS.
 *
 * @param addresses of the page for operators, the likeliest first
 * @param fingerprint SHA-256 of the authority's certificate, as the terminal shows it, too
 */
export function installPage(addresses: readonly string[], fingerprint: string): string {
  const [first = ''] = addresses;
  const others = addresses
    .slice(1)
    .map((address) => `<li><a href="${escapeHtml(address)}">${escapeHtml(address)}</a></li>`)
    .join('');
  return page(
    'Open Farpoint on this device',
    `<ol>
<li><p><a class="go" href="${CERTIFICATE_PATH}">Get the certificate</a></p></li>
<li><p>Install it:</p><ul>
<li><b>Android, Quest:</b> open the file, or <i>Settings → Security → Encryption &amp; credentials → Install a certificate → CA certificate</i>.</li>
<li><b>iPhone, iPad, Vision Pro:</b> install the profile in <i>Settings</i>, then switch it on in <i>General → About → Certificate Trust Settings</i>.</li>
<li><b>Windows:</b> open the file, <i>Install certificate</i>, into <i>Trusted Root Certification Authorities</i>.</li>
<li><b>macOS:</b> open the file, and let <i>Keychain Access</i> always trust it.</li>
<li><b>Firefox:</b> <i>Settings → Privacy &amp; Security → View certificates → Authorities → Import</i>.</li>
</ul></li>
<li><p><a class="go" href="${escapeHtml(first)}">Open Farpoint</a></p></li>
</ol>
<p>The certificate vouches for addresses and names of local networks only, never for a site of the internet. Its fingerprint, which the terminal shows as well:<br><code>${escapeHtml(fingerprint)}</code></p>
<p>Without the certificate, a browser warns before it opens Farpoint, and a headset may refuse VR.</p>
${others === '' ? '' : `<p>Other addresses of the same service:</p><ul>${others}</ul>`}
<p>For another device:</p>${renderSVG(first)}`,
  );
}
