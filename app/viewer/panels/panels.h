// The panels: what they show is the session, what they change goes through its edit list. Each is drawn into
// the current ImGui window.
#pragma once

#include "app/viewer/session.h"

namespace cutis::app {

void drawRigPanel(Session& session);    // the list of lights
void drawLightPanel(Session& session);  // the chosen one
void drawPresetPanel(Session& session);
void drawCameraPanel(Session& session);
void drawEnvironmentPanel(Session& session);
void drawSkinPanel(Session& session);
void drawComparePanel(Session& session);
void drawPlanPanel(Session& session);

// These make windows of their own.
void drawViewBar(Session& session,
                 const PixelRect& where);  // above the picture: what it shows, what dragging does
void drawTimeLine(Session& session, const PixelRect& where);  // below the picture: which animation, and when
void drawMixerStrip(Session& session, const PixelRect& where);
float drawMenuBar(Session& session);  // returns its height
void drawStatusBar(Session& session, float height);
void drawHelp(Session& session);
void drawDialogs(Session& session);

}  // namespace cutis::app
