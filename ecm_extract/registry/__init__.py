"""The registry: contracts of all releases, who uses what, channels and gates, impact and resolution (DESIGN §8).

Needs the extra `ecm-extract[registry]`. `Registry` of `ecm_extract.registry.store` opens one; every question and
every change is a function that takes it:

| module | what it does |
|---|---|
| `publish` | keep a release for ever |
| `index` | keep all release tags of repositories |
| `releases` | which releases are there |
| `users` | who uses what a release provides |
| `impact` | who breaks when a release is published |
| `environments` | what runs where, and whether a release may go there |
| `evidence`, `waivers`, `migrations` | what is known of a release beside its contract |
| `promotion` | gates, channels, deprecation, withdrawal |
| `resolution` | one release of each family, or the shortest reason why not |
| `verify` | whether all that is stored is as it was stored |
"""
