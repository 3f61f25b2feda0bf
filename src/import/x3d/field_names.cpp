#include "import/x3d/field_names.h"

#include <algorithm>
#include <string>
#include <unordered_map>

namespace imgeo::x3d {

namespace {

/// All names with capital letters: the fields of X3D 4.0 (ISO/IEC 19775-1) and its XML encoding (ISO/IEC 19776-1), and
/// those that X3DOM, X_ITE and imgeo add.
constexpr std::string_view capitalisedNames =
    "accessType acousticProperties actionKeyPress actionKeyRelease activeLayer activeLayerNode "
    "activeNavigationInfo activeViewpoint addChildren addedEntities addGeometry addTrimmingContour "
    "alphaClipThreshold alphaCutoff alphaEquation alphaFactor alphaFunc alphaFuncValue alphaMode "
    "alphaTextureChannelMask alphaTextureCoordinatesId alphaTextureId altGrKey altKey ambientFactor "
    "ambientIntensity ambientTexture ambientTextureChannelMask ambientTextureCoordinatesId ambientTextureId "
    "ambientTextureMapping anchorPoint angleRate angularDampingFactor angularVelocity anisotropicDegree "
    "anisotropyRotation anisotropyStrength anisotropyTexture anisotropyTextureMapping annotationGroupID "
    "antennaLocation antennaPatternLength antennaPatternType applicationID appliedParameters "
    "articulationParameterArray articulationParameterChangeIndicatorArray articulationParameterCount "
    "articulationParameterDesignatorArray articulationParameterIdPartAttachedToArray "
    "articulationParameterTypeArray AS aspectRatio attenuationColor attenuationDistance attributeStride autoCalc "
    "autoDamp autoDisable autoOffset autoRefinement autoRefresh autoRefreshTimeLimit availableViewers avatarSize "
    "axis1Angle axis1Torque axis2Angle axis2Torque axis3Angle axis3Torque axisOfRotation axisRotation "
    "backAmbientIntensity backDiffuseColor backEmissiveColor backMaterial backShininess backSpecularColor "
    "backTexture backTransparency backUrl baseColor baseTexture baseTextureMapping bbMaxModF bbMin bbMinModF "
    "bboxCenter bboxDisplay bboxSize bbShiftVec beamWidth beginCap bindTime binormalTextureCoordinatesId "
    "binormalType blendColor blendMode body1AnchorPoint body1Axis body2AnchorPoint body2Axis borderColor "
    "borderWidth bottomRadius bottomTexture bottomUrl boundaryModeR boundaryModeS boundaryModeT boundaryOpacity "
    "bufferDuration bufferLength bvhType byteFrequencyData byteTimeDomainData cameraEvents cappingColor "
    "cappingStrength castShadow centerOfMass centerOfRotation centerOfRotationOffset channelCount "
    "channelCountMode channelInterpretation channelMask channelSelection channelsEnabled child1Url child2Url "
    "child3Url child4Url clearcoatNormalTexture clearcoatNormalTextureMapping clearcoatRoughness "
    "clearcoatRoughnessTexture clearcoatRoughnessTextureMapping clearcoatTexture clearcoatTextureMapping "
    "clipBoundary closureType collideTime collisionType colorEquation colorIndex colorKey colorOffset "
    "colorPerVertex colorPrecision colorSpaceConversion colorSteps colorTransparency colorType commandKey "
    "commencePose compoundShape coneInnerAngle coneOuterAngle coneOuterGain constantForceMix contactNormal "
    "contactSurfaceThickness containerField contentType contourStepSize controlKey controlPoint coolColor "
    "coordIndex coordType countPrimitives creaseAngle createParticles crossOrigin crossSection crossSectionCurve "
    "cryptoKeyID cryptoSystem cutOffAngle cycleInterval cycleTime dataLength deadReckoning DEF delayTime "
    "deletionAllowed depthFunc depthFunction depthMap depthMask depthMode depthRange depthTest "
    "desiredAngularVelocity1 desiredAngularVelocity2 destFactor destinationAlphaFactor destinationColorFactor "
    "detonateTime detonationLocation detonationRelativeLocation detonationResult diffuseCoefficients "
    "diffuseColor diffuseFactor diffuseTexture diffuseTextureChannelMask diffuseTextureCoordinatesId "
    "diffuseTextureId diffuseTextureMapping diffuseTransmission diffuseTransmissionColor "
    "diffuseTransmissionColorTexture diffuseTransmissionColorTextureMapping diffuseTransmissionTexture "
    "diffuseTransmissionTextureMapping directOutput disableAngularSpeed disableLinearSpeed disableTime diskAngle "
    "displacementAxis displacementFactor displacementsTexture displacementTextureCoordinatesId "
    "displacementTextureId displacementWeights displacementWeightsTexture displayEvents displayPolicy "
    "distanceModel doPickPass dopplerEnabled drawOrder dropOffRate easeInEaseOut edgeColor elapsedTime "
    "emissiveColor emissiveFactor emissiveStrength emissiveTexture emissiveTextureChannelMask "
    "emissiveTextureCoordinatesId emissiveTextureId emissiveTextureMapping enableARC enableCulling enabledAxes "
    "enableDepthTest enableHRTF encodingScheme endAngle endCap endEvents endFrame enteredText enterTime "
    "entityCategory entityCountry entityDomain entityExtra entityID entityKind entitySpecific entitySubcategory "
    "environmentFactor environmentTextureChannelMask environmentTextureCoordinatesId environmentTextureId "
    "errorCorrection evenLive eventApplicationID eventEntityID eventNumber eventSiteID exitTime explorationMode "
    "eyeToScreenDistance fanCount farDistance fftSize fieldOfView fieldOfViewOffset fieldOfViewScale "
    "fillProperties finalText finishedEvents finiteRotationAxis firedTime fireMissionIndex firingRange "
    "firingRate firstCycle floatFrequencyData floatTimeDomainData fogCoord fogType fontStyle forceID forceOutput "
    "forceTransitions frameCount frameDuration frameIncrement frameIndex frequencyBinCount fresnelBlend "
    "frictionCoefficients frictionDirection fromField fromNode frontTexture frontUrl frustumCulling "
    "gammaCorrectionDefault generateMipMaps geoCenter geoCoords geoGridOrigin geometryType geoOrigin geoSystem "
    "gradientThreshold groundAngle groundColor hasHelperColors hatchColor hatchStyle hideChildren hinge1Angle "
    "hinge1AngleRate hinge2Angle hinge2AngleRate idOffset idsPerVertex implicitMeshCount implicitMeshMode "
    "implicitMeshSize importedDEF "
    "indexedRendering indexOfRefraction indexType initialDestination initialValue initialVisibility inlineDEF "
    "innerRadius inputFalse inputNegate inputSource inputTrue insideOutsideRadius integerKey intensityThreshold "
    "interauralDistance interpupillaryDistance intersectionType invertAlphaTexture invisibleNodes "
    "iridescenceIndexOfRefraction iridescenceTexture iridescenceTextureMapping iridescenceThicknessMaximum "
    "iridescenceThicknessMinimum iridescenceThicknessTexture iridescenceThicknessTextureMapping isActive isBound "
    "isBoundedObject isCameraObject isCollided isCollisionObject isDetonated isLoaded isNetworkReader "
    "isNetworkWriter isOver isPaused isPickable isPickableObject isPointingObject isRtpHeaderHeard isSelected "
    "isShadowObject isSRGB isStandAlone isValid isVisibleObject jointBindingPositions jointBindingRotations "
    "jointBindingScales jointName jointTextures keyPress keyRelease keyValue keyVelocity layoutPolicy "
    "leadLineStyle leftTexture leftToRight leftUrl lengthOfModulationParameters lensCenter lifetimeVariation "
    "limitOrientation linearAcceleration linearDampingFactor linearVelocity lineBounds lineProperties "
    "lineSegments linewidthScaleFactor loadCount loadData loadState loadTime localDEF loopEnd loopStart "
    "lowPriorityCulling lowPriorityFactor lowPriorityThreshold magnificationFilter mapDEFToID maskA maskB maskG "
    "maskR massDensityModel matchCriterion maxAngle maxAngle1 maxBack maxBBSize maxChannelCount "
    "maxCorrectionSpeed maxDecibels maxDelayTime maxDepth maxDistance maxExtent maxFrameRate maxFront "
    "maximumNumberFrames maxLevel maxObjectsPerNode maxParticles maxPosition maxPrecisionLevel maxRenderedIds "
    "maxSeparation maxTorque1 maxTorque2 mediaDeviceID metallicRoughnessTexture metallicRoughnessTextureMapping "
    "minAngle minAngle1 minBack minBounceSpeed minDecibels minFrameRate minFront minificationFilter minPosition "
    "minPrecisionLevel minRelativeBBoxSize minSeparation modulationTypeDetail modulationTypeMajor "
    "modulationTypeSpreadSpectrum modulationTypeSystem momentsOfInertia motionsEnabled motor1Angle "
    "motor1AngleRate motor1Axis motor2Angle motor2AngleRate motor2Axis motor3Angle motor3AngleRate motor3Axis "
    "multicastRelayHost multicastRelayPort multiscatterColor multiscatterColorTexture "
    "multiscatterColorTextureMapping munitionApplicationID munitionEndPoint munitionEntityID munitionQuantity "
    "munitionSiteID munitionStartPoint mustEvaluate nameSpaceName navigationInfo navType nearDistance "
    "networkMode nodeField normalAsSphericalCoordinates normalBias normalEncoding normalFormat normalIndex "
    "normalizeVelocity normalOffset normalPerVertex normalPrecision normalScale normalSpace normalTexture "
    "normalTextureChannelMask normalTextureCoordinatesId normalTextureId normalTextureMapping normalType "
    "normalUpdateMode numAnchorVertices numberOfChannels numberOfSlices numColorComponents numComponents "
    "numIndices numTexCoordComponents objectType occlusionCulling occlusionStrength occlusionTexture "
    "occlusionTextureMapping occlusionVisibilityFactor occlusionVisibilityThreshold oculusRiftVersion "
    "offsetUnits opacityFactor optionsImag optionsReal orientationOffset origChannelCount originalVertexCount "
    "orthogonalColor otherGeometry outerRadius parallelColor particleLifetime particleSize pauseTime "
    "periodicWave phaseFunction pickedGeometry pickedNormal pickedPoint pickedTextureCoordinate pickingGeometry "
    "pickMode pickTarget playbackRate pointerEvents pointProperties pointSize pointSizeMaxValue "
    "pointSizeMinValue pointSizeScaleFactor polygonOffset positionBits positionOffset positionPrecision "
    "precisionFactor preferAccuracy prepareEvents primType profileCurve protoField qualityFactor "
    "radioEntityTypeCategory radioEntityTypeCountry radioEntityTypeDomain radioEntityTypeKind "
    "radioEntityTypeNomenclature radioEntityTypeNomenclatureVersion radioID readInterval readOnly receivedPower "
    "receiverState recordCount referenceDistance referencePoint reflectionFactor reflectionTextureChannelMask "
    "reflectionTextureCoordinatesId reflectionTextureId relativeAntennaLocation relativeIndexOfRefraction "
    "removeChildren removedEntities removeGeometry removeTrimmingContour renderedTextures renderStyle repeatR "
    "repeatS repeatT replaceImage resetAllJoints resumeTime retainedOpacity retainUserOffsets rgbaColors "
    "rightTexture rightUrl rolloffFactor rootNode rootNodes rootUrl rotateYUp rtpHeaderExpected sampleRate "
    "scaleKey scaleMode scaleOffset scaleOrientation scaleOrientationOffset scaleOrientations "
    "scaleRenderedIdsOnMove scatterAnisotropy segmentEnabled segmentIdentifiers sensorEvents separateBackColor "
    "separationRate shadowBias shadowCascades shadowColor shadowExcludeTransparentObjects shadowFilterSize "
    "shadowIntensity shadowMapSize shadowObjectIdMapping shadowOffset shadowSplitFactor shadowSplitOffset "
    "sheenColor sheenColorTexture sheenColorTextureMapping sheenRoughness sheenRoughnessTexture "
    "sheenRoughnessTextureMapping shiftKey shininessFactor shininessTexture shininessTextureChannelMask "
    "shininessTextureCoordinatesId shininessTextureId shininessTextureMapping showDebugBoxVolumes shownGroupID "
    "showNormals silhouetteBoundaryOpacity silhouetteRetainedOpacity silhouetteSharpness siteID sizeUnits "
    "skeletalConfiguration skinBindingCoords skinBindingNormals skinCoord skinCoordIndex skinCoordWeight "
    "skinNormal skyAngle skyColor slicesOverX slicesOverY sliderForce slipCoefficients slipFactors "
    "smallFeatureCulling smallFeatureFactor smallFeatureThreshold smoothingTimeConstant softnessConstantForceMix "
    "softnessErrorCorrection sortKey sortOrder sortTrans sortType sourceAlphaFactor sourceColorFactor "
    "specularColor specularColorTexture specularColorTextureMapping specularFactor specularGlossinessTexture "
    "specularGlossinessTextureMapping specularStrength specularTexture specularTextureChannelMask "
    "specularTextureCoordinatesId specularTextureId specularTextureMapping speedFactor sphericalNormals "
    "srcFactor startAngle startFrame startIndex startTime stereoMode stop1Bounce stop1ConstantForceMix "
    "stop1ErrorCorrection stop2Bounce stop2ErrorCorrection stop3Bounce stop3ErrorCorrection stopBounce "
    "stopErrorCorrection stopTime streamIdentifier stripCount subScale surfaceArea surfaceDistance surfaceNormals "
    "surfaceSpeed surfaceTolerance surfaceValues suspensionErrorCorrection suspensionForce tailTime "
    "tangentTextureCoordinatesId tangentType targetObject tdlType tessellationDetailCulling "
    "tessellationErrorFactor tessellationErrorThreshold tessellationScale texCoord texCoordIndex texCoordKey "
    "texCoordMapping texcoordOffset texcoordPrecision texCoordType textBounds textureCompression "
    "textureCoordinatesId texturePriority textureProperties textureTransform textureZ thicknessTexture "
    "thicknessTextureMapping tightSize timeEvents timeOut toField toNode topRadius topTexture topToBottom topUrl "
    "touchTime trackCurrentView trajectoryCurve transferFunction transformSensors transitionActive "
    "transitionComplete transitionDuration transitionStart transitionTime transitionType transmissionFactor "
    "transmissionTexture transmissionTextureChannelMask transmissionTextureCoordinatesId transmissionTextureId "
    "transmissionTextureMapping transmitFrequencyBandwidth transmitState transmitterApplicationID "
    "transmitterEntityID transmitterRadioID transmitterSiteID triggerTime triggerTrue triggerValue "
    "trimmingContour typeParams uClosed uDimension uKnot uOrder updateInstances updateInterval upVector "
    "urlCenter urlHead urlIDMap urlTail USE useFiniteRotation useGeoCache useGeometry useGlobalGravity "
    "userDataFactor uTessellation valueBits valueMin valueSize vClosed vDimension vertexBufferSize vertexCount "
    "vertexDataBufferOffset viewAll visibilityLimit visibilityRange visibilityStart vKnot volumeScatter vOrder "
    "vScreenSize vTessellation warmColor weightConstant1 weightConstant2 weightFunction1 weightFunction2 "
    "weightTransferFunction1 weightTransferFunction2 whichChoice whichGeometry worldInfos writeInterval "
    "xDimension xSpacing yDimension yScale zDimension zFar zFarRange zNear zNearRange zSpacing ";

std::string lowerCased(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

} // namespace

std::string_view fieldNameOf(std::string_view attribute) {
  static const std::unordered_map<std::string, std::string_view> byLowerCase = [] {
    std::unordered_map<std::string, std::string_view> map;
    for (std::size_t at = 0; at < capitalisedNames.size();) {
      const std::size_t end = capitalisedNames.find(' ', at);
      const std::string_view name = capitalisedNames.substr(at, end - at);
      map.emplace(lowerCased(name), name);
      at = end + 1;
    }
    return map;
  }();
  const auto found = byLowerCase.find(lowerCased(attribute));
  return found == byLowerCase.end() ? attribute : found->second;
}

} // namespace imgeo::x3d
